/// The normal law, and how sure a sampled share is.

/** Density of the normal law. */
export function normalDensity(x: number, mean: number, deviation: number): number {
  const z = (x - mean) / deviation;
  return Math.exp(-(z * z) / 2) / (deviation * Math.sqrt(2 * Math.PI));
}

export interface Share {
  hits: number;
  n: number;
  share: number;
  /** Wilson's interval of 95 %. */
  lo: number;
  hi: number;
}

const z95 = 1.959963984540054;

/** The share of `hits` among `n` with Wilson's interval of 95 %; null where nothing was counted. */
export function wilson(hits: number, n: number): Share | null {
  if (n < 1) return null;
  const share = hits / n;
  const z2 = (z95 * z95) / n;
  const middle = (share + z2 / 2) / (1 + z2);
  const half = (z95 / (1 + z2)) * Math.sqrt((share * (1 - share)) / n + z2 / (4 * n));
  return { hits, n, share, lo: Math.max(0, middle - half), hi: Math.min(1, middle + half) };
}

/** How many of the values exceed a bound, among those that are numbers. */
export function shareAbove(values: ArrayLike<number>, bound: number): Share | null {
  let [hits, n] = [0, 0];
  for (let i = 0; i < values.length; i++) {
    const value = values[i]!;
    if (Number.isNaN(value)) continue;
    n++;
    if (value > bound) hits++;
  }
  return wilson(hits, n);
}
