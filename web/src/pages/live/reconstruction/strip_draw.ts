/// One strip a channel: the true attack dashed in ink, the reconstructed one in its lane's colour, every entry marked.
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { plotWidth, xOf, type Geometry } from '../../../chart/geometry';
import { extent, fit, fraction, tickLabel, type Scale } from '../../../chart/scale';
import { decimate, type Series } from '../../../data/series';
import type { Entry, Tally } from './tally';

export interface Strip {
  injected: Series;
  found: Series;
  tally: Tally;
}

interface Box {
  y: number;
  height: number;
}

/** Room between two strips, px. */
const between = 5;
/** Entries are marked one by one down to this distance of two ticks, px. */
export const leastPerTick = 1.6;

export function stripBoxes(g: Geometry, count: number): Box[] {
  const each = (g.height - g.top - g.bottom) / Math.max(1, count);
  return Array.from({ length: count }, (_, i) => ({ y: g.top + i * each + between / 2, height: Math.max(8, each - between) }));
}

/** Holds both curves and zero; null where there is nothing but zero. */
export function stripScale({ injected, found }: Strip, from: number, to: number): Scale | null {
  const values = extent([injected, found], from, to, false);
  if (!values || (values.lo === 0 && values.hi === 0)) return null;
  return fit({ lo: Math.min(0, values.lo), hi: Math.max(0, values.hi) }, false);
}

const zero: Scale = { log: false, lo: -1, hi: 1 };

export function drawStripAxes(context: CanvasRenderingContext2D, g: Geometry, boxes: readonly Box[], scales: readonly (Scale | null)[]): void {
  context.font = axisFont;
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  context.lineWidth = 1;
  boxes.forEach((box, i) => {
    const scale = scales[i] ?? zero;
    const at = (value: number): number => Math.round(box.y + box.height * (1 - fraction(scale, value))) + 0.5;
    context.strokeStyle = colour('line');
    context.beginPath();
    context.moveTo(g.left, at(0));
    context.lineTo(g.width - g.right, at(0));
    context.stroke();
    context.fillStyle = colour('muted');
    const inside = (value: number): number => Math.min(Math.max(at(value), box.y + 5), box.y + box.height - 4);
    const ends = scale === zero ? [] : [scale.lo, scale.hi].filter((value) => value !== 0);
    // Zero gives way to an end that would lie on it.
    const free = ends.every((value) => Math.abs(inside(value) - inside(0)) >= 11);
    for (const value of [...ends, ...(free ? [0] : [])]) context.fillText(tickLabel(value), g.left - 6, inside(value));
  });
}

export function drawStrip(context: CanvasRenderingContext2D, g: Geometry, box: Box, scale: Scale | null, strip: Strip, token: string): void {
  const y = (value: number): number => box.y + box.height * (1 - fraction(scale ?? zero, value));
  const buckets = Math.ceil(plotWidth(g));
  context.lineWidth = 1.4;
  context.strokeStyle = colour(token);
  stroke(context, g, decimate(strip.found, buckets), y, []);
  context.lineWidth = 1.2;
  context.strokeStyle = colour('ink');
  stroke(context, g, decimate(strip.injected, buckets), y, [6, 4]);
  const perTick = plotWidth(g) / (g.to - g.from || 1);
  if (perTick < leastPerTick) return;
  const radius = Math.min(3, Math.max(1.7, 0.4 * perTick));
  for (const entry of strip.tally.entries) drawEntry(context, xOf(g, entry.k), y, entry, radius, token);
}

function stroke(context: CanvasRenderingContext2D, g: Geometry, series: Series, y: (value: number) => number, dash: number[]): void {
  context.setLineDash(dash);
  context.beginPath();
  let pen = false;
  for (let i = 0; i < series.k.length; i++) {
    const x = xOf(g, series.k[i]!);
    for (const value of series.lo === series.hi ? [series.lo[i]!] : [series.lo[i]!, series.hi[i]!]) {
      if (Number.isNaN(value)) {
        pen = false;
        continue;
      }
      if (pen && series.joined[i]) context.lineTo(x, y(value));
      else context.moveTo(x, y(value));
      pen = true;
    }
  }
  context.stroke();
  context.setLineDash([]);
}

/** A hit is a solid circle where it was found, a miss a hollow one where it should have been, a false entry a triangle. */
function drawEntry(context: CanvasRenderingContext2D, x: number, y: (value: number) => number, entry: Entry, radius: number, token: string): void {
  context.beginPath();
  if (entry.verdict === 'false') {
    const at = y(entry.found);
    const size = radius + 1;
    context.fillStyle = colour('bad');
    context.moveTo(x, at - size);
    context.lineTo(x + size, at + 0.8 * size);
    context.lineTo(x - size, at + 0.8 * size);
    context.fill();
    return;
  }
  context.arc(x, y(entry.verdict === 'hit' ? entry.found : entry.injected), radius, 0, 2 * Math.PI);
  if (entry.verdict === 'hit') {
    context.fillStyle = colour(token);
    context.fill();
    return;
  }
  context.fillStyle = colour('surface');
  context.fill();
  context.lineWidth = 1;
  context.strokeStyle = colour('ink');
  context.stroke();
}
