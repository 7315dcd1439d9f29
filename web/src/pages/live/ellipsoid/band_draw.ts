/// One component over time: the band of what the filter allows, its estimate, and the truth.
import { colour } from '../../../chart/colours';
import { xOf, type Geometry } from '../../../chart/geometry';
import { fit, fraction, type Scale } from '../../../chart/scale';
import type { Series } from '../../../data/series';
import type { Band } from './estimates';

export function bandScale(band: Band, truth: Series, from: number, to: number): Scale {
  let lo = Infinity;
  let hi = -Infinity;
  const take = (value: number): void => {
    if (Number.isNaN(value)) return;
    lo = Math.min(lo, value);
    hi = Math.max(hi, value);
  };
  for (let i = 0; i < band.k.length; i++) {
    if (band.k[i]! < from || band.k[i]! > to) continue;
    const wide = Number.isNaN(band.outer[i]!) ? 0 : band.outer[i]!;
    take(band.middle[i]! - wide);
    take(band.middle[i]! + wide);
  }
  for (let i = 0; i < truth.k.length; i++) if (truth.k[i]! >= from && truth.k[i]! <= to) [truth.lo[i]!, truth.hi[i]!].forEach(take);
  return fit(lo <= hi ? { lo, hi } : null, false);
}

export function drawBand(context: CanvasRenderingContext2D, g: Geometry, scale: Scale, band: Band, truth: Series, token: string): void {
  const y = (value: number): number => g.height - g.bottom - fraction(scale, value) * (g.height - g.top - g.bottom);
  context.fillStyle = colour(token);
  for (const [half, alpha] of [
    [band.outer, 0.12],
    [band.inner, 0.22],
  ] as const) {
    context.globalAlpha = alpha;
    fill(context, g, band, half, y);
  }
  context.globalAlpha = 1;
  context.strokeStyle = colour(token);
  context.lineWidth = 1.6;
  stroke(context, g, band.k, band.joined, [band.middle], y);
  context.strokeStyle = colour('ink');
  context.lineWidth = 1.8;
  context.setLineDash([6, 4]);
  stroke(context, g, truth.k, truth.joined, truth.lo === truth.hi ? [truth.lo] : [truth.lo, truth.hi], y);
  context.setLineDash([]);
}

/** Filled between both edges, stretch by stretch. */
function fill(context: CanvasRenderingContext2D, g: Geometry, band: Band, half: Float64Array, y: (value: number) => number): void {
  for (let begin = 0; begin < band.k.length; ) {
    let end = begin;
    while (end < band.k.length && !Number.isNaN(half[end]! + band.middle[end]!) && (end === begin || band.joined[end])) end++;
    if (end > begin + 1) {
      context.beginPath();
      for (let i = begin; i < end; i++) context.lineTo(xOf(g, band.k[i]!), y(band.middle[i]! + half[i]!));
      for (let i = end - 1; i >= begin; i--) context.lineTo(xOf(g, band.k[i]!), y(band.middle[i]! - half[i]!));
      context.fill();
    }
    begin = Math.max(end, begin + 1);
  }
}

function stroke(context: CanvasRenderingContext2D, g: Geometry, k: Float64Array, joined: Uint8Array, sides: readonly Float64Array[], y: (value: number) => number): void {
  context.lineJoin = 'round';
  context.beginPath();
  let pen = false;
  for (let i = 0; i < k.length; i++) {
    const x = xOf(g, k[i]!);
    for (const side of sides) {
      const value = side[i]!;
      if (Number.isNaN(value)) {
        pen = false;
        continue;
      }
      if (pen && joined[i]) context.lineTo(x, y(value));
      else context.moveTo(x, y(value));
      pen = true;
    }
  }
  context.stroke();
}
