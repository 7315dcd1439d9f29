import type { Geometry } from '../../chart/geometry';

/** What a panel draws into: grid below, data above, and a box for a library's own canvas. */
export interface PlotContext {
  g: Geometry;
  under: CanvasRenderingContext2D;
  main: HTMLCanvasElement;
  held: HTMLElement;
  following: boolean;
}
