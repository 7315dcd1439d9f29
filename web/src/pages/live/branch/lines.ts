/// The other branch's curves: the same signals, thin and dotted, from the fork on.
import { emptySeries, type Series } from '../../../data/series';
import type { Source } from '../../../data/source';
import type { LineSpec } from '../lines';

export const branchDash: readonly number[] = [2, 3];
export const branchWidth = 1.2;

/** A series without what was before tick `from`. */
export function after(series: Series, from: number): Series {
  let begin = 0;
  while (begin < series.k.length && series.k[begin]! < from) begin++;
  if (begin === 0) return series;
  if (begin === series.k.length) return emptySeries;
  const joined = series.joined.slice(begin);
  joined[0] = 0;
  const lo = series.lo.subarray(begin);
  return { k: series.k.subarray(begin), lo, hi: series.lo === series.hi ? lo : series.hi.subarray(begin), joined };
}

/** Whether the other branch has what a line draws. */
export function drawnBy(line: Pick<LineSpec, 'signal' | 'minus'>, source: Pick<Source, 'byName'>): boolean {
  return source.byName.has(line.signal) && (line.minus === undefined || source.byName.has(line.minus));
}
