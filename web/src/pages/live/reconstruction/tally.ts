/// How a reconstructed attack compares with the true one, tick by tick: an entry is there where it is not zero.
import type { Series } from '../../../data/series';
import { wrap } from './channels';

export type Verdict = 'hit' | 'miss' | 'false';

export interface Entry {
  k: number;
  injected: number;
  found: number;
  verdict: Verdict;
}

export interface Tally {
  /** Only ticks at which there is an entry on either side. */
  entries: Entry[];
  hits: number;
  misses: number;
  falses: number;
  /** Ticks at which both are known. */
  known: number;
  /** False where samples are reduced: single ticks cannot be judged. */
  exact: boolean;
}

export function verdictOf(injected: number, found: number): Verdict | null {
  if (injected !== 0) return found !== 0 ? 'hit' : 'miss';
  return found !== 0 ? 'false' : null;
}

/** Compares inside [from, to]; a tick at which one of the two is missing is not judged. */
export function tally(injected: Series, found: Series, from: number, to: number, period = 0): Tally {
  const result: Tally = { entries: [], hits: 0, misses: 0, falses: 0, known: 0, exact: injected.lo === injected.hi && found.lo === found.hi };
  if (!result.exact) return result;
  let j = 0;
  for (let i = 0; i < found.k.length; i++) {
    const k = found.k[i]!;
    if (k < from || k > to) continue;
    while (j < injected.k.length && injected.k[j]! < k) j++;
    const truth = injected.k[j] === k ? injected.hi[j]! : NaN;
    const said = found.hi[i]!;
    if (Number.isNaN(truth) || Number.isNaN(said)) continue;
    result.known++;
    const verdict = verdictOf(truth, said);
    if (!verdict) continue;
    result.entries.push({ k, injected: wrap(truth, period), found: wrap(said, period), verdict });
    if (verdict === 'hit') result.hits++;
    else if (verdict === 'miss') result.misses++;
    else result.falses++;
  }
  return result;
}

/** A series of angles with every value wrapped. Extremes of reduced samples keep their order. */
export function wrapSeries(series: Series, period: number): Series {
  if (!period) return series;
  const lo = series.lo.map((value) => wrap(value, period));
  if (series.lo === series.hi) return { ...series, lo, hi: lo };
  const hi = series.hi.map((value) => wrap(value, period));
  return { ...series, lo: lo.map((value, i) => Math.min(value, hi[i]!)), hi: hi.map((value, i) => Math.max(value, lo[i]!)) };
}
