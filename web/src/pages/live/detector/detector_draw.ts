/// The statistic against its thresholds, and below it the alarm strip: one picture, one axis of time.
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { plotWidth, xOf, type Geometry } from '../../../chart/geometry';
import { extent, fit, fraction, type Scale } from '../../../chart/scale';
import { decimate, type Series } from '../../../data/series';
import type { Stretch as Attack } from '../schedule/stretches';
import type { Crossing, Stretch } from './strip';

export interface DrawnLine {
  series: Series;
  /** What it is drawn from: another branch of the run has it, too. */
  signal?: string;
  token: string;
  width: number;
  dash: readonly number[];
}

export interface StripRow {
  label: string;
  /** Of the lane. */
  token: string;
  /** The true attack: drawn as a band with its letter. */
  attacks?: readonly Attack[];
  stretches?: readonly Stretch[];
  strong?: boolean;
}

/** The chart's own geometry, and where the rows are. */
export interface Layout {
  chart: Geometry;
  rows: { y: number; height: number }[];
}

const between = 8;

/** The strip takes what its rows need, at most half of the height. */
export function layoutOf(g: Geometry, rows: number): Layout {
  const inner = g.height - g.top - g.bottom;
  const each = rows ? Math.max(5, Math.min(14, Math.floor((0.52 * inner) / rows))) : 0;
  const strip = rows * each;
  const top = g.height - g.bottom - strip;
  const chart = { ...g, bottom: g.bottom + strip + (rows ? between : 0) };
  return { chart, rows: Array.from({ length: rows }, (_, i) => ({ y: top + i * each, height: each })) };
}

/** A logarithmic scale needs something above zero: without it the scale is linear. */
export function scaleOf(lines: readonly DrawnLine[], g: Geometry, log: boolean): Scale {
  const series = lines.map((line) => line.series);
  const positive = log ? extent(series, g.from, g.to, true) : null;
  if (positive) return fit(positive, true);
  const values = extent(series, g.from, g.to, false);
  return fit(values && { lo: Math.min(0, values.lo), hi: values.hi }, false);
}

export function drawAttacks(context: CanvasRenderingContext2D, g: Geometry, attacks: readonly Attack[]): void {
  for (const { from, to, token, letter } of attacks) {
    const [x0, x1] = [Math.max(g.left, xOf(g, from - 0.5)), Math.min(g.width - g.right, xOf(g, to - 0.5))];
    if (x1 <= x0) continue;
    context.globalAlpha = 0.12;
    context.fillStyle = colour(token);
    context.fillRect(x0, g.top, x1 - x0, g.height - g.top - g.bottom);
    context.globalAlpha = 1;
    if (letter && x1 - x0 > 14) badge(context, (x0 + x1) / 2, g.top + 8, letter, token);
  }
}

function badge(context: CanvasRenderingContext2D, x: number, y: number, letter: string, token: string): void {
  context.fillStyle = colour(token);
  context.font = "600 11px 'IBM Plex Mono', monospace";
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(letter, x, y);
}

export function drawLine(context: CanvasRenderingContext2D, g: Geometry, scale: Scale, line: DrawnLine): void {
  const height = g.height - g.top - g.bottom;
  const series = decimate(line.series, Math.ceil(plotWidth(g)));
  context.strokeStyle = colour(line.token);
  context.lineWidth = line.width;
  context.lineJoin = 'round';
  context.setLineDash([...line.dash]);
  context.beginPath();
  let pen = false;
  for (let i = 0; i < series.k.length; i++) {
    const x = xOf(g, series.k[i]!);
    for (const value of series.lo === series.hi ? [series.lo[i]!] : [series.lo[i]!, series.hi[i]!]) {
      // What a logarithmic scale has no place for lies on its floor: a zero is seen to be there.
      const share = Number.isNaN(value) ? NaN : Math.min(1.02, Math.max(0, scale.log && value <= 0 ? 0 : fraction(scale, value)));
      if (Number.isNaN(share)) {
        pen = false;
        continue;
      }
      const y = g.height - g.bottom - share * height;
      if (pen && series.joined[i]) context.lineTo(x, y);
      else context.moveTo(x, y);
      pen = true;
    }
  }
  context.stroke();
  context.setLineDash([]);
}

/** Up into a hit: solid. Up without an attack: a triangle. Down while the attack goes on: hollow. */
export function drawCrossing(context: CanvasRenderingContext2D, x: number, y: number, kind: Crossing['kind'], token: string): void {
  if (kind === 'false') {
    triangle(context, x, y, 4.5);
    return;
  }
  context.beginPath();
  context.arc(x, y, 3.6, 0, 2 * Math.PI);
  context.fillStyle = colour(kind === 'hit' ? token : 'surface');
  context.fill();
  context.lineWidth = 1.4;
  context.strokeStyle = colour(kind === 'hit' ? 'surface' : 'ink');
  context.stroke();
}

function triangle(context: CanvasRenderingContext2D, x: number, y: number, size: number): void {
  context.beginPath();
  context.moveTo(x, y - size);
  context.lineTo(x + size, y + 0.8 * size);
  context.lineTo(x - size, y + 0.8 * size);
  context.fillStyle = colour('bad');
  context.fill();
}

export function drawStripLabels(context: CanvasRenderingContext2D, g: Geometry, layout: Layout, rows: readonly StripRow[]): void {
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  rows.forEach((row, i) => {
    const { y, height } = layout.rows[i]!;
    const size = Math.min(10.5, Math.max(7.5, height - 0.5));
    context.font = row.strong ? `600 ${size}px 'IBM Plex Mono', monospace` : axisFont.replace('10.5px', `${size}px`);
    context.fillStyle = colour(row.strong ? 'ink' : 'muted');
    context.fillText(row.label, g.left - 6, y + height / 2);
    context.fillStyle = colour('grid');
    context.fillRect(g.left, Math.round(y + height) - 1, g.width - g.left - g.right, 1);
  });
}

export function drawStripRow(context: CanvasRenderingContext2D, g: Geometry, place: { y: number; height: number }, row: StripRow): void {
  const [top, height] = [place.y + 1, place.height - 3];
  for (const { from, to, token, letter } of row.attacks ?? []) {
    const [x0, x1] = [xOf(g, from - 0.5), xOf(g, to - 0.5)];
    context.fillStyle = colour(token);
    context.fillRect(x0, top, Math.max(1.5, x1 - x0), height);
    if (letter && x1 - x0 > 14 && height > 7) letterIn(context, (x0 + x1) / 2, top + height / 2, letter);
  }
  for (const stretch of row.stretches ?? []) drawStretch(context, xOf(g, stretch.from - 0.5), xOf(g, stretch.to + 0.5), top, height, stretch, row.token);
}

function letterIn(context: CanvasRenderingContext2D, x: number, y: number, letter: string): void {
  context.fillStyle = colour('surface');
  context.font = "600 9px 'IBM Plex Mono', monospace";
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(letter, x, y + 0.5);
}

function drawStretch(context: CanvasRenderingContext2D, x0: number, x1: number, top: number, height: number, { sign }: Stretch, token: string): void {
  const width = Math.max(1.5, x1 - x0);
  if (sign === 'hit') {
    context.fillStyle = colour(token);
    context.fillRect(x0, top, width, height);
  } else if (sign === 'miss') {
    context.strokeStyle = colour(token);
    context.lineWidth = 1;
    context.strokeRect(x0 + 0.5, top + 0.5, Math.max(0.5, width - 1), height - 1);
  } else if (sign === 'false') {
    context.fillStyle = colour('bad');
    context.fillRect(x0, top + height - 1.5, width, 1.5);
    triangle(context, (x0 + x1) / 2, top + height / 2, Math.min(4, height / 2));
  } else {
    context.fillStyle = colour(sign === 'uncounted' ? 'control' : 'line');
    const thin = sign === 'uncounted' ? height / 2 : 1;
    context.fillRect(x0, top + (height - thin) / 2, width, thin);
  }
}
