/// One signal over a window, raw or reduced to extremes: what every panel draws from.
import type { Samples } from '../api/types';
import type { Ring } from './ring';

export interface Series {
  k: Float64Array;
  lo: Float64Array;
  /** The same array as `lo` where the samples are raw. */
  hi: Float64Array;
  /** 1 where a point goes on from the one before; 0 after missing ticks. */
  joined: Uint8Array;
}

export const emptySeries: Series = { k: new Float64Array(0), lo: new Float64Array(0), hi: new Float64Array(0), joined: new Uint8Array(0) };

/** A column of a ring from tick `from` to `to`, with one row more on each side so that lines reach the edges. */
export function ringSeries(ring: Ring, column: number, from: number, to: number): Series {
  const begin = Math.max(0, ring.lower(from) - 1);
  const end = Math.min(ring.length, ring.lower(to + 1) + 1);
  const length = Math.max(0, end - begin);
  const k = new Float64Array(length);
  const v = new Float64Array(length);
  const joined = new Uint8Array(length);
  for (let i = 0; i < length; i++) {
    k[i] = ring.tick(begin + i);
    v[i] = ring.value(column, begin + i);
    joined[i] = ring.joined(begin + i) ? 1 : 0;
  }
  return { k, lo: v, hi: v, joined };
}

/** The usual distance of neighbouring ticks: their median. */
export function usualStep(k: ArrayLike<number>): number {
  if (k.length < 2) return 1;
  const steps = new Float64Array(k.length - 1);
  for (let i = 1; i < k.length; i++) steps[i - 1] = k[i]! - k[i - 1]!;
  steps.sort();
  return steps[steps.length >> 1]!;
}

/** The server's answer as series by signal name. Ticks further apart than usual, or with a gap between them, are not joined. */
export function samplesSeries(samples: Samples): Map<string, Series> {
  const k = Float64Array.from(samples.k);
  const step = usualStep(k);
  const joined = new Uint8Array(k.length);
  for (let i = 1; i < k.length; i++) {
    const lost = samples.gaps?.some((gap) => gap.from <= k[i]! && gap.to > k[i - 1]!);
    joined[i] = k[i]! - k[i - 1]! <= 1.5 * step && !lost ? 1 : 0;
  }
  const result = new Map<string, Series>();
  for (const one of samples.series) {
    const lo = numbers('v' in one ? one.v : one.lo);
    const hi = 'v' in one ? lo : numbers(one.hi);
    result.set(one.signal, { k, lo, hi, joined });
  }
  return result;
}

function numbers(values: readonly (number | null)[]): Float64Array {
  const result = new Float64Array(values.length);
  for (let i = 0; i < result.length; i++) result[i] = values[i] ?? NaN;
  return result;
}

/** Joins two pieces of one signal, the second beginning after the first. */
export function concatSeries(a: Series, b: Series): Series {
  if (a.k.length === 0) return b;
  if (b.k.length === 0) return a;
  const last = a.k[a.k.length - 1]!;
  let skip = 0;
  while (skip < b.k.length && b.k[skip]! <= last) skip++;
  const raw = a.lo === a.hi && b.lo === b.hi;
  const join = <T extends Float64Array | Uint8Array>(x: T, y: T): T => {
    const Type = x.constructor as new (n: number) => T;
    const out = new Type(x.length + y.length - skip);
    out.set(x as never);
    out.set(y.subarray(skip) as never, x.length);
    return out;
  };
  const lo = join(a.lo, b.lo);
  return { k: join(a.k, b.k), lo, hi: raw ? lo : join(a.hi, b.hi), joined: join(a.joined, b.joined) };
}

/**
 * a - b at the ticks that both have: two streams do not arrive in step. Of reduced samples the widest range that the
 * extremes allow, so that no peak is lost.
 */
export function difference(a: Series, b: Series): Series {
  const most = Math.min(a.k.length, b.k.length);
  const raw = a.lo === a.hi && b.lo === b.hi;
  const k = new Float64Array(most);
  const lo = new Float64Array(most);
  const hi = raw ? lo : new Float64Array(most);
  const joined = new Uint8Array(most);
  let length = 0;
  let whole = false;
  for (let i = 0, j = 0; i < a.k.length && j < b.k.length; ) {
    if (a.k[i]! < b.k[j]!) {
      whole &&= a.joined[i] === 1;
      i++;
    } else if (a.k[i]! > b.k[j]!) {
      whole &&= b.joined[j] === 1;
      j++;
    } else {
      k[length] = a.k[i]!;
      lo[length] = a.lo[i]! - b.hi[j]!;
      hi[length] = a.hi[i]! - b.lo[j]!;
      joined[length] = whole && a.joined[i] && b.joined[j] ? 1 : 0;
      whole = true;
      length++;
      i++;
      j++;
    }
  }
  const low = lo.subarray(0, length);
  return { k: k.subarray(0, length), lo: low, hi: raw ? low : hi.subarray(0, length), joined: joined.subarray(0, length) };
}

/** What is made of series that stay as they are, kept as long as they are: a drawing asks for it again and again. */
const made = new WeakMap<Float64Array, { with: Float64Array | null; series: Series }>();

function kept(from: Float64Array, beside: Float64Array | null, make: () => Series): Series {
  const known = made.get(from);
  if (known?.with === beside) return known.series;
  const series = make();
  made.set(from, { with: beside, series });
  return series;
}

/**
 * a - b of two signals that move together. Of reduced samples of the same ticks the difference of their least and of their
 * greatest values: both lie within the true difference's range, however far the two moved between two points.
 */
export function closeDifference(a: Series, b: Series): Series {
  return kept(a.hi, b.hi, () => {
    const same = a.lo !== a.hi && a.k.length === b.k.length && a.k.every((k, i) => k === b.k[i]);
    if (!same) return difference(a, b);
    const low = a.lo.map((v, i) => v - b.lo[i]!);
    const high = a.hi.map((v, i) => v - b.hi[i]!);
    return { k: a.k, lo: low.map((v, i) => Math.min(v, high[i]!)), hi: high.map((v, i) => Math.max(v, low[i]!)), joined: a.joined };
  });
}

/** Share of the greatest below which a size is drawn as that share: an error that crosses zero must not stretch a logarithmic scale. */
const leastShare = 1e-5;

/** Absolute values, for a logarithmic scale; of reduced samples the greatest of each bucket. */
export function magnitude(series: Series): Series {
  return kept(series.hi, null, () => {
    const size = series.lo.map((v, i) => Math.max(Math.abs(v), Math.abs(series.hi[i]!)));
    const greatest = size.reduce((most, v) => (v > most ? v : most), 0);
    const floored = size.map((v) => (v < leastShare * greatest ? leastShare * greatest : v));
    return { ...series, lo: floored, hi: floored };
  });
}

/** The newest value at or before tick k, no older than `reach` ticks; NaN if none. */
export function valueAt(series: Series, k: number, reach = Infinity): number {
  let low = 0;
  let high = series.k.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (series.k[middle]! <= k) low = middle + 1;
    else high = middle;
  }
  const i = low - 1;
  return i >= 0 && k - series.k[i]! <= reach ? series.hi[i]! : NaN;
}

/**
 * At most two points a bucket: the least and the greatest of each, in the order in which they came.
 * A peak of one tick survives any reduction. `buckets` is the number of pixels.
 */
export function decimate(series: Series, buckets: number): Series {
  const length = series.k.length;
  if (length <= 2 * buckets) return series;
  const from = series.k[0]!;
  const width = (series.k[length - 1]! - from) / buckets || 1;
  const keep: number[] = [];
  for (let i = 0; i < length; ) {
    const edge = from + width * (Math.floor((series.k[i]! - from) / width) + 1);
    let least = -1;
    let most = -1;
    let j = i;
    for (; j < length && (series.k[j]! < edge || j === i); j++) {
      if (Number.isNaN(series.lo[j]!)) continue;
      if (least < 0 || series.lo[j]! < series.lo[least]!) least = j;
      if (most < 0 || series.hi[j]! > series.hi[most]!) most = j;
    }
    if (least < 0) keep.push(i);
    else if (least === most) keep.push(least);
    else keep.push(Math.min(least, most), Math.max(least, most));
    i = j;
  }
  return pick(series, keep);
}

function pick(series: Series, rows: readonly number[]): Series {
  const k = new Float64Array(rows.length);
  const lo = new Float64Array(rows.length);
  const hi = series.lo === series.hi ? lo : new Float64Array(rows.length);
  const joined = new Uint8Array(rows.length);
  let before = 0;
  rows.forEach((row, i) => {
    k[i] = series.k[row]!;
    lo[i] = series.lo[row]!;
    hi[i] = series.hi[row]!;
    let whole = i > 0;
    for (let j = before + 1; whole && j <= row; j++) whole = series.joined[j] === 1;
    joined[i] = whole ? 1 : 0;
    before = row;
  });
  return { k, lo, hi, joined };
}

/** Stretches of missing ticks inside [from, to], as open intervals of ticks. */
export function gapsOf(series: Series, from: number, to: number): { from: number; to: number }[] {
  const gaps: { from: number; to: number }[] = [];
  for (let i = 1; i < series.k.length; i++) {
    if (series.joined[i]) continue;
    const gap = { from: Math.max(from, series.k[i - 1]!), to: Math.min(to, series.k[i]!) };
    if (gap.to > gap.from) gaps.push(gap);
  }
  return gaps;
}
