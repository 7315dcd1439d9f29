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
  /** As many independent ones say as much. */
  worth: number;
  /** Wilson's interval of 95 %. */
  lo: number;
  hi: number;
}

const z95 = 1.959963984540054;

/** The share of `hits` among `n` with Wilson's interval of 95 % for `worth` independent ones; null where nothing was counted. */
export function wilson(hits: number, n: number, worth = n): Share | null {
  if (n < 1) return null;
  const share = hits / n;
  const z2 = (z95 * z95) / worth;
  const middle = (share + z2 / 2) / (1 + z2);
  const half = (z95 / (1 + z2)) * Math.sqrt((share * (1 - share)) / worth + z2 / (4 * worth));
  return { hits, n, share, worth, lo: Math.max(0, middle - half), hi: Math.min(1, middle + half) };
}

/**
 * How many independent values are worth as much as these successive ones: n / (1 + 2 (rho_1 + rho_2 + ...)), the sum of
 * the sampled correlations up to the first pair of neighbouring lags that is not positive (Geyer's rule).
 */
export function independent(values: readonly number[]): number {
  const n = values.length;
  if (n < 2) return n;
  const mean = values.reduce((sum, value) => sum + value, 0) / n;
  const away = values.map((value) => value - mean);
  const product = (lag: number): number => {
    let sum = 0;
    for (let i = lag; i < n; i++) sum += away[i]! * away[i - lag]!;
    return sum;
  };
  const variance = product(0);
  if (!(variance > 0)) return 1;
  let sum = 1;
  for (let lag = 1; lag + 1 < Math.min(n, mostLags); lag += 2) {
    const two = (product(lag) + product(lag + 1)) / variance;
    if (two <= 0) break;
    sum += 2 * two;
  }
  return Math.max(1, Math.min(n, n / sum));
}

/** Losses farther apart share no noise that counts; a long run stays quick. */
const mostLags = 500;

/** How many of the values exceed a bound, among those that are numbers. */
export function shareAbove(values: readonly number[], bound: number): Share | null {
  const numbers = values.filter((value) => !Number.isNaN(value));
  return wilson(numbers.filter((value) => value > bound).length, numbers.length, independent(numbers));
}
