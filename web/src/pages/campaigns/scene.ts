/// A drawing as a list of marks: the same list is painted on a canvas and written as SVG. CSS pixels.
import { axisFont } from '../../chart/axes';
import type { Scale } from '../../chart/scale';
import type { Box } from './plot';

export interface Stroke {
  colour: string;
  width?: number;
  dash?: readonly number[];
  alpha?: number;
}

export type Mark =
  | ({ type: 'line'; points: readonly number[] } & Stroke)
  /** Many lines of equally many points, all with the same stroke. */
  | ({ type: 'lines'; points: Float32Array; each: number } & Stroke)
  | { type: 'area'; points: readonly number[]; fill: string; alpha?: number }
  | { type: 'rect'; x: number; y: number; width: number; height: number; fill?: string; alpha?: number; outline?: string }
  | { type: 'dot'; x: number; y: number; radius: number; fill?: string; outline?: string; alpha?: number }
  /** Many alike: x and y by turns. */
  | { type: 'dots'; points: readonly number[]; radius: number; fill: string; alpha?: number }
  | { type: 'text'; x: number; y: number; text: string; fill: string; align?: 'start' | 'middle' | 'end'; turned?: boolean };

/** Something that has values to read. */
export interface Hit {
  x: number;
  y: number;
  text: string;
  /** What a click on it means to the figure, e.g. a trial's index. */
  key?: number;
  /** Drawn strongly while it is pointed at: x and y by turns. */
  path?: ArrayLike<number>;
}

/** What can be pointed at, in the order in which the keyboard goes through it. */
export interface Hits {
  count: number;
  at: (i: number) => Hit;
  /** The nearest one within reach of a place, -1: none. */
  near: (x: number, y: number) => number;
}

export interface Scene {
  width: number;
  height: number;
  marks: Mark[];
  /** Drawn above them and cut at a box: what a zoom may push out of it. */
  inside?: { box: Box; marks: Mark[] };
  hits?: Hits;
  /** Scales that can be zoomed. */
  axes?: { box: Box; x?: Scale; y?: Scale };
}

/** What a figure is zoomed to, in values; an axis that is missing is whole. */
export interface Zoom {
  x?: { lo: number; hi: number };
  y?: { lo: number; hi: number };
}

/** Lines stroked in one go: where they overlap within it, their transparency does not add up. */
const kAtOnce = 25;

function trace(context: CanvasRenderingContext2D, points: ArrayLike<number>, from: number, to: number): void {
  let down = false;
  for (let i = from; i < to; i += 2) {
    const x = points[i]!;
    const y = points[i + 1]!;
    if (!Number.isFinite(x) || !Number.isFinite(y)) down = false;
    else if (down) context.lineTo(x, y);
    else {
      context.moveTo(x, y);
      down = true;
    }
  }
}

function stroke(context: CanvasRenderingContext2D, mark: Stroke): void {
  context.strokeStyle = mark.colour;
  context.lineWidth = mark.width ?? 1;
  context.setLineDash([...(mark.dash ?? [])]);
  context.stroke();
}

function paintLines(context: CanvasRenderingContext2D, mark: Extract<Mark, { type: 'lines' }>): void {
  const stride = 2 * mark.each;
  for (let from = 0; from < mark.points.length; from += stride * kAtOnce) {
    context.beginPath();
    for (let i = from; i < Math.min(from + stride * kAtOnce, mark.points.length); i += stride) trace(context, mark.points, i, i + stride);
    stroke(context, mark);
  }
}

function paintDots(context: CanvasRenderingContext2D, { points, radius, fill }: Extract<Mark, { type: 'dots' }>): void {
  context.fillStyle = fill;
  for (let from = 0; from < points.length; from += 2 * kAtOnce) {
    context.beginPath();
    for (let i = from; i < Math.min(points.length, from + 2 * kAtOnce); i += 2) {
      context.moveTo(points[i]! + radius, points[i + 1]!);
      context.arc(points[i]!, points[i + 1]!, radius, 0, 2 * Math.PI);
    }
    context.fill();
  }
}

function paintText(context: CanvasRenderingContext2D, mark: Extract<Mark, { type: 'text' }>): void {
  context.font = axisFont;
  context.fillStyle = mark.fill;
  context.textBaseline = 'middle';
  context.textAlign = mark.align === 'middle' ? 'center' : (mark.align ?? 'start');
  context.translate(mark.x, mark.y);
  if (mark.turned) context.rotate(-Math.PI / 2);
  context.fillText(mark.text, 0, 0);
}

function paintMark(context: CanvasRenderingContext2D, mark: Mark): void {
  context.globalAlpha = 'alpha' in mark && mark.alpha !== undefined ? mark.alpha : 1;
  if (mark.type === 'lines') return paintLines(context, mark);
  if (mark.type === 'text') return paintText(context, mark);
  if (mark.type === 'dots') return paintDots(context, mark);
  context.beginPath();
  if (mark.type === 'line' || mark.type === 'area') trace(context, mark.points, 0, mark.points.length);
  if (mark.type === 'rect') context.rect(mark.x, mark.y, mark.width, mark.height);
  if (mark.type === 'dot') context.arc(mark.x, mark.y, mark.radius, 0, 2 * Math.PI);
  if (mark.type === 'line') return stroke(context, mark);
  if (mark.fill) {
    context.fillStyle = mark.fill;
    context.fill();
  }
  if ((mark.type === 'rect' || mark.type === 'dot') && mark.outline) stroke(context, { colour: mark.outline, width: 1.6 });
}

function paintAll(context: CanvasRenderingContext2D, marks: readonly Mark[]): void {
  for (const mark of marks) {
    context.save();
    paintMark(context, mark);
    context.restore();
  }
}

export function paint(context: CanvasRenderingContext2D, scene: Scene): void {
  paintAll(context, scene.marks);
  if (!scene.inside) return;
  const { box, marks } = scene.inside;
  context.save();
  context.beginPath();
  context.rect(box.left - 4, box.top - 4, box.right - box.left + 8, box.bottom - box.top + 8);
  context.clip();
  paintAll(context, marks);
  context.restore();
}
