/// Vertical scales and their ticks.
import type { Series } from '../data/series';

export interface Scale {
  log: boolean;
  lo: number;
  hi: number;
  /** Where a symmetric logarithmic scale, asinh(value / middle), goes over from linear to logarithmic. A power of ten. */
  middle?: number;
}

/** 0 at the bottom, 1 at the top; NaN where a logarithmic scale has no place for the value. */
export function fraction(scale: Scale, value: number): number {
  if (scale.log) return value > 0 ? (Math.log10(value) - Math.log10(scale.lo)) / (Math.log10(scale.hi) - Math.log10(scale.lo)) : NaN;
  if (scale.middle) {
    const lo = Math.asinh(scale.lo / scale.middle);
    return (Math.asinh(value / scale.middle) - lo) / (Math.asinh(scale.hi / scale.middle) - lo);
  }
  return (value - scale.lo) / (scale.hi - scale.lo);
}

/** Least and greatest number in the window; positive ones only for a logarithmic scale. Null if there is none. */
export function extent(all: readonly Series[], from: number, to: number, positive: boolean): { lo: number; hi: number } | null {
  let lo = Infinity;
  let hi = -Infinity;
  for (const series of all) {
    for (let i = 0; i < series.k.length; i++) {
      const k = series.k[i]!;
      if (k < from || k > to) continue;
      const low = series.lo[i]!;
      const high = series.hi[i]!;
      if (low < lo && (!positive || low > 0)) lo = low;
      if (high > hi && (!positive || high > 0)) hi = high;
    }
  }
  if (positive && hi > 0 && lo === Infinity) lo = hi;
  return lo <= hi ? { lo, hi } : null;
}

/** Whence the values of a window count for its scale: from `settled` on where the window goes well beyond it, else all of them. */
export function countedFrom(from: number, to: number, settled: number): number {
  return settled > from && to > 1.5 * settled ? settled : from;
}

/** A scale that holds the values with some room: whole decade halves when logarithmic, so that it changes seldom. */
export function fit(values: { lo: number; hi: number } | null, log: boolean, middle = 0): Scale {
  if (middle) return { log: false, middle, lo: -beyond(-(values?.lo ?? 0), middle), hi: beyond(values?.hi ?? 0, middle) };
  if (!values) return log ? { log, lo: 0.1, hi: 10 } : { log, lo: 0, hi: 1 };
  if (log) {
    const hi = Math.ceil(Math.log10(values.hi) * 2 + 0.2) / 2;
    const lo = Math.floor(Math.log10(values.lo) * 2 - 0.2) / 2;
    return { log, lo: 10 ** lo, hi: 10 ** Math.max(hi, lo + 1) };
  }
  if (values.lo === 0 && values.hi === 0) return { log, lo: -1, hi: 1 };
  const step = niceStep(Math.max(values.hi - values.lo, Math.abs(values.hi) * 1e-6, 1e-12) / 4);
  const lo = Math.floor(values.lo / step) * step;
  const hi = Math.ceil(values.hi / step) * step;
  return { log, lo, hi: hi > lo ? hi : lo + step };
}

/** The next half decade beyond a size, at least the middle. */
function beyond(size: number, middle: number): number {
  return size <= 0.9 * middle ? middle : 10 ** (Math.ceil(Math.log10(size) * 2 + 0.1) / 2);
}

/** Whether a value needs another scale. */
export function outside(scale: Scale, value: number): boolean {
  return Number.isFinite(value) && (value > scale.hi || (value < scale.lo && (!scale.log || value > 0)));
}

/** 1, 2 or 5 times a power of ten, not below `rough`. */
export function niceStep(rough: number): number {
  const power = 10 ** Math.floor(Math.log10(rough));
  const ratio = rough / power;
  return (ratio <= 1 ? 1 : ratio <= 2 ? 2 : ratio <= 5 ? 5 : 10) * power;
}

/** About `count` round numbers in [lo, hi]. */
export function ticks(lo: number, hi: number, count: number): number[] {
  if (!(hi > lo)) return [];
  const step = niceStep((hi - lo) / Math.max(1, count));
  const result: number[] = [];
  for (let i = Math.ceil(lo / step - 1e-9); i * step <= hi + step * 1e-9; i++) result.push(Number((i * step).toPrecision(12)));
  return result;
}

export function scaleTicks(scale: Scale, count: number): number[] {
  if (scale.middle) return symmetricTicks(scale, scale.middle, count);
  if (!scale.log) return ticks(scale.lo, scale.hi, count);
  const low = Math.ceil(Math.log10(scale.lo) - 1e-9);
  const high = Math.floor(Math.log10(scale.hi) + 1e-9);
  const every = Math.max(1, Math.ceil((high - low + 1) / Math.max(2, count)));
  const result: number[] = [];
  for (let p = low; p <= high; p += every) result.push(10 ** p);
  return result;
}

/** 0 and powers of ten on both sides, no closer together than `count` of them would be. */
function symmetricTicks(scale: Scale, middle: number, count: number): number[] {
  const apart = 1 / Math.max(2, count);
  const origin = fraction(scale, 0);
  const result = [0];
  for (const sign of [1, -1]) {
    let last = origin;
    for (let size = middle; sign * size <= scale.hi * (1 + 1e-9) && sign * size >= scale.lo * (1 + 1e-9); size *= 10) {
      const at = fraction(scale, sign * size);
      if (Math.abs(at - last) < apart) continue;
      result.push(sign * Number(size.toPrecision(12)));
      last = at;
    }
  }
  return result.sort((a, b) => a - b);
}

/** A tick's label: short, plain where it can be. */
export function tickLabel(value: number): string {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) {
    const [mantissa, exponent] = value.toExponential(0).split('e') as [string, string];
    return `${mantissa === '1' ? '' : `${mantissa}·`}10${superscript(Number(exponent))}`;
  }
  return String(Number(value.toPrecision(6)));
}

function superscript(value: number): string {
  return String(value).replace(/[-0-9]/g, (c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)]!));
}
