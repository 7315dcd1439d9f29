/// How often an error has which size: a histogram and a smooth line, both of unit area.

export interface Histogram {
  from: number;
  /** Width of a bin. */
  width: number;
  /** Density of each bin. */
  density: Float64Array;
  count: number;
}

/** Share of the sorted values up to which something lies. */
function quantile(sorted: ArrayLike<number>, share: number): number {
  const at = share * (sorted.length - 1);
  const low = Math.floor(at);
  const high = Math.min(sorted.length - 1, low + 1);
  return sorted[low]! + (at - low) * (sorted[high]! - sorted[low]!);
}

export interface Summary {
  count: number;
  mean: number;
  /** Standard deviation, ddof 1. */
  deviation: number;
  /** The smaller of the deviation and the interquartile range / 1.349: what outliers do not move. */
  spread: number;
  least: number;
  most: number;
}

export function summaryOf(values: readonly number[]): Summary | null {
  if (values.length < 2) return null;
  const sorted = Float64Array.from(values).sort();
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  const deviation = Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (values.length - 1));
  const quartiles = (quantile(sorted, 0.75) - quantile(sorted, 0.25)) / 1.349;
  return { count: values.length, mean, deviation, spread: quartiles > 0 ? Math.min(deviation, quartiles) : deviation, least: sorted[0]!, most: sorted.at(-1)! };
}

/** Bins of equal width over [from, to]; values outside are left out of the bins and kept in the count. */
export function histogramOf(values: readonly number[], from: number, to: number, bins: number): Histogram {
  const width = (to - from) / bins;
  const density = new Float64Array(bins);
  for (const value of values) {
    const bin = Math.min(bins - 1, Math.floor((value - from) / width));
    if (value >= from && value <= to) density[bin]!++;
  }
  if (values.length) for (let i = 0; i < bins; i++) density[i]! /= values.length * width;
  return { from, width, density, count: values.length };
}

/** Bins by the rule of Freedman and Diaconis, 8 to 60. */
export function binsFor(summary: Summary, from: number, to: number): number {
  const width = (2 * 1.349 * summary.spread) / Math.cbrt(summary.count);
  return Math.max(8, Math.min(60, width > 0 ? Math.round((to - from) / width) : 8));
}

/**
 * A Gaussian kernel estimate at `points` places over [from, to], bandwidth 0.9 spread n^(-1/5) (Silverman). Values are
 * gathered on the places first, each shared between its two neighbours: the cost does not grow with their number.
 */
export function smoothOf(values: readonly number[], summary: Summary, from: number, to: number, points: number): Float64Array {
  const step = (to - from) / (points - 1);
  const weights = new Float64Array(points);
  for (const value of values) {
    const at = (value - from) / step;
    const low = Math.floor(at);
    if (low < 0 || low >= points - 1) {
      if (at === points - 1) weights[points - 1]!++;
      continue;
    }
    weights[low]! += 1 - (at - low);
    weights[low + 1]! += at - low;
  }
  const bandwidth = Math.max(0.9 * summary.spread * summary.count ** -0.2, step / 2);
  const reach = Math.ceil((4 * bandwidth) / step);
  const kernel = Float64Array.from({ length: reach + 1 }, (_, i) => Math.exp(-(((i * step) / bandwidth) ** 2) / 2) / (bandwidth * Math.sqrt(2 * Math.PI)));
  const line = new Float64Array(points);
  for (let i = 0; i < points; i++) {
    let sum = 0;
    for (let j = Math.max(0, i - reach); j <= Math.min(points - 1, i + reach); j++) sum += weights[j]! * kernel[Math.abs(i - j)]!;
    line[i] = sum / values.length;
  }
  return line;
}

/** Where the pictures of several sets begin and end: their values with a little room, one far outlier not stretching it beyond 12 spreads. */
export function spanOf(summaries: readonly Summary[]): { from: number; to: number } | null {
  if (!summaries.length) return null;
  const reach = Math.max(...summaries.map(({ spread }) => 12 * spread));
  const from = Math.min(...summaries.map(({ least, mean }) => Math.max(least, mean - reach)));
  const to = Math.max(...summaries.map(({ most, mean }) => Math.min(most, mean + reach)));
  const room = Math.max(0.05 * (to - from), 1e-9);
  return { from: from - room, to: to + room };
}

/** Errors at ticks from `first` on; with `state`, only where nothing is attacked. */
export function errorsOf(k: readonly number[], estimate: readonly number[], truth: readonly number[], first: number, state: readonly number[] | null): number[] {
  const errors: number[] = [];
  for (let i = 0; i < k.length; i++) {
    if (k[i]! < first || (state && state[i]! > 0)) continue;
    const error = estimate[i]! - truth[i]!;
    if (Number.isFinite(error)) errors.push(error);
  }
  return errors;
}
