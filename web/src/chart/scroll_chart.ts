/// Lines that scroll: the picture is shifted by whole pixels and only what is new is drawn, whatever the history's length.
import type { Series } from '../data/series';
import { prepare } from './axes';
import { plotHeight, plotWidth, type Geometry } from './geometry';
import { countedFrom, extent, fit, fraction, outside, type Scale } from './scale';

export interface Line {
  key: string;
  /** Samples between two ticks. */
  get: (from: number, to: number) => Series;
  colour: string;
  width: number;
  dash: number[];
}

/** Redrawn whole this often even if nothing forces it, so that the scale can tighten. */
const redrawEvery = 120;

export class ScrollChart {
  scale: Scale;
  private base = 0;
  private lastTo = -1;
  private state = '';
  private since = 0;
  /** Length drawn so far of each line, so that dashes go on where they stopped. */
  private lengths = new Map<string, number>();
  /** Newest tick drawn of each line: streams of one run do not arrive in step. */
  private drawn = new Map<string, number>();

  constructor(
    private readonly log: boolean,
    private readonly middle = 0,
    /** Values before this tick do not stretch the scale. */
    private readonly settled = 0,
  ) {
    this.scale = fit(null, log, middle);
  }

  /** Forgets what was drawn: the next drawing is whole. */
  reset(): void {
    this.state = '';
  }

  draw(canvas: HTMLCanvasElement, g: Geometry, lines: readonly Line[], dataVersion: string): void {
    const ratio = devicePixelRatio || 1;
    const width = Math.round(plotWidth(g) * ratio);
    const height = Math.round(plotHeight(g) * ratio);
    const perTick = width / (g.to - g.from || 1);
    const base = Math.floor(g.to * perTick);
    const state = `${width} ${height} ${g.to - g.from} ${dataVersion} ${lines.map((line) => `${line.key}${line.colour}${line.width}`).join()}`;
    const shift = base - this.base;
    const scrolls = state === this.state && g.to >= this.lastTo && shift < width / 2 && this.since < redrawEvery;
    if (scrolls && this.scroll(canvas, lines, { width, height, perTick, base, shift, to: g.to, ratio })) return;
    this.whole(canvas, g, lines, { width, height, perTick, base, ratio });
    this.state = state;
    this.lastTo = g.to;
    this.base = base;
    this.since = 0;
  }

  private whole(canvas: HTMLCanvasElement, g: Geometry, lines: readonly Line[], p: { width: number; height: number; perTick: number; base: number; ratio: number }): void {
    const context = prepare(canvas, plotWidth(g), plotHeight(g));
    if (!context) return;
    const all = lines.map((line) => line.get(g.from, g.to));
    this.scale = fit(extent(all, countedFrom(g.from, g.to, this.settled), g.to, this.log), this.log, this.middle);
    context.setTransform(1, 0, 0, 1, 0, 0);
    this.lengths.clear();
    this.drawn.clear();
    lines.forEach((line, i) => this.stroke(context, line, all[i]!, p));
  }

  /** False where a new value does not fit the scale. */
  private scroll(
    canvas: HTMLCanvasElement,
    lines: readonly Line[],
    p: { width: number; height: number; perTick: number; base: number; shift: number; to: number; ratio: number },
  ): boolean {
    const context = canvas.getContext('2d');
    if (!context) return false;
    const fresh = lines.map((line) => line.get(this.drawn.get(line.key) ?? p.to, p.to));
    for (const series of fresh) {
      for (let i = 0; i < series.k.length; i++) if (series.k[i]! >= this.settled && (outside(this.scale, series.hi[i]!) || outside(this.scale, series.lo[i]!))) return false;
    }
    context.setTransform(1, 0, 0, 1, 0, 0);
    if (p.shift > 0) {
      context.globalCompositeOperation = 'copy';
      context.drawImage(canvas, -p.shift, 0);
      context.globalCompositeOperation = 'source-over';
    }
    lines.forEach((line, i) => this.stroke(context, line, fresh[i]!, p));
    this.base = p.base;
    this.lastTo = p.to;
    if (p.shift > 0) this.since++;
    return true;
  }

  /** Draws the segments that are not drawn yet. */
  private stroke(
    context: CanvasRenderingContext2D,
    line: Line,
    series: Series,
    p: { width: number; height: number; perTick: number; base: number; ratio: number },
  ): void {
    context.strokeStyle = line.colour;
    context.lineWidth = line.width * p.ratio;
    context.lineJoin = 'round';
    context.setLineDash(line.dash.map((d) => d * p.ratio));
    const after = this.drawn.get(line.key) ?? -Infinity;
    let length = this.lengths.get(line.key) ?? 0;
    context.lineDashOffset = length;
    context.beginPath();
    let px = NaN;
    let py = NaN;
    // One subpath as long as the line goes on: a dash starts afresh with every subpath.
    let pen = false;
    const raw = series.lo === series.hi;
    for (let i = 0; i < series.k.length; i++) {
      const k = series.k[i]!;
      const x = k * p.perTick - p.base + p.width - 1;
      for (let half = 0; half < (raw ? 1 : 2); half++) {
        const y = p.height * (1 - fraction(this.scale, half === 0 ? series.lo[i]! : series.hi[i]!));
        if (Number.isNaN(y)) {
          px = NaN;
          pen = false;
          continue;
        }
        const joins = !Number.isNaN(px) && (half > 0 || series.joined[i] === 1);
        if (k > after) {
          if (joins) {
            if (!pen) context.moveTo(px, py);
            context.lineTo(x, y);
            length += Math.hypot(x - px, y - py);
          } else {
            context.moveTo(x - p.ratio, y);
            context.lineTo(x, y);
          }
          pen = true;
        }
        px = x;
        py = y;
      }
    }
    context.stroke();
    context.setLineDash([]);
    this.lengths.set(line.key, length);
    const newest = series.k[series.k.length - 1];
    if (newest !== undefined) this.drawn.set(line.key, Math.max(after, newest));
  }
}
