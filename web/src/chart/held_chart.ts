/// Lines that stand still, drawn by uPlot in the same box as the scrolling ones: nothing jumps between the two.
import type uPlot from 'uplot';
import { decimate, type Series } from '../data/series';
import { plotHeight, plotWidth, type Geometry } from './geometry';
import type { Line } from './scroll_chart';
import { countedFrom, extent, fit, type Scale } from './scale';

type Table = [number[], (number | null)[]];

/** A series as uPlot's columns: extremes become a zigzag, missing ticks a break. */
export function tableOf(series: Series, log: boolean): Table {
  const x: number[] = [];
  const y: (number | null)[] = [];
  const raw = series.lo === series.hi;
  const put = (k: number, value: number): void => {
    x.push(k);
    y.push(Number.isFinite(value) && (!log || value > 0) ? value : null);
  };
  for (let i = 0; i < series.k.length; i++) {
    const k = series.k[i]!;
    if (i > 0 && !series.joined[i]) {
      x.push((k + series.k[i - 1]!) / 2);
      y.push(null);
    }
    put(k, series.lo[i]!);
    if (!raw) {
      const next = series.k[i + 1] ?? k + 1;
      put(k + (next - k) / 2, series.hi[i]!);
    }
  }
  return [x, y];
}

export class HeldChart {
  scale: Scale;
  private plot: uPlot | null = null;
  private library: typeof uPlot | null = null;
  private drawn = '';

  constructor(
    private readonly log: boolean,
    private readonly ready: () => void,
    private readonly middle = 0,
    /** Values before this tick do not stretch the scale. */
    private readonly settled = 0,
  ) {
    this.scale = fit(null, log, middle);
  }

  /** Draws into `box` if something changed. False while the library is on its way. */
  draw(box: HTMLElement, g: Geometry, lines: readonly Line[], dataVersion: string): boolean {
    if (!this.library) {
      void this.load();
      return false;
    }
    const state = `${plotWidth(g)} ${plotHeight(g)} ${g.from} ${g.to} ${dataVersion} ${lines.map((line) => `${line.key}${line.colour}${line.width}`).join()}`;
    if (state === this.drawn) return true;
    const width = plotWidth(g);
    const all = lines.map((line) => decimate(line.get(g.from, g.to), Math.ceil(width)));
    this.scale = fit(extent(all, countedFrom(g.from, g.to, this.settled), g.to, this.log), this.log, this.middle);
    const tables = all.map((series) => tableOf(series, this.log)).map(([x, y]) => [x, y] as uPlot.AlignedData);
    const data: uPlot.AlignedData = tables.length ? this.library.join(tables) : [[]];
    this.clear();
    this.plot = new this.library(this.options(g, lines), data, box);
    this.drawn = state;
    return true;
  }

  clear(): void {
    this.plot?.destroy();
    this.plot = null;
    this.drawn = '';
  }

  private async load(): Promise<void> {
    const [module] = await Promise.all([import('uplot'), import('uplot/dist/uPlot.min.css')]);
    if (this.library) return;
    this.library = module.default;
    this.ready();
  }

  private options(g: Geometry, lines: readonly Line[]): uPlot.Options {
    return {
      width: plotWidth(g),
      height: plotHeight(g),
      padding: [0, 0, 0, 0],
      pxAlign: 0,
      legend: { show: false },
      cursor: { show: false },
      axes: [{ show: false }, { show: false }],
      scales: {
        x: { time: false, range: [g.from, g.to] },
        y: { ...(this.middle ? { distr: 4, asinh: this.middle } : { distr: this.log ? 3 : 1 }), range: [this.scale.lo, this.scale.hi] },
      },
      series: [{}, ...lines.map((line) => ({ stroke: line.colour, width: line.width, dash: line.dash, points: { show: false }, pxAlign: 0, spanGaps: false }))],
    };
  }
}
