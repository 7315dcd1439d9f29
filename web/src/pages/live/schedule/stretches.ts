import type { Series } from '../../../data/series';
import { sensorRasterCell } from './schedule_cells';

export interface Stretch {
  /** First tick, and the one after the last. */
  from: number;
  to: number;
  token: string;
  letter?: string;
}

/** Stretches of time in which a sensor was attacked in one way; a reduced point stands up to the next one. */
export function stretches(series: Series): Stretch[] {
  const result: Stretch[] = [];
  for (let i = 0; i < series.k.length; i++) {
    const several = series.lo[i] !== series.hi[i];
    const cell = Number.isNaN(series.hi[i]!) ? null : sensorRasterCell(series.hi[i]!, several);
    if (!cell) continue;
    const from = series.k[i]!;
    const next = series.k[i + 1];
    // A frame that stands for several ticks reaches back to the one before it.
    const raw = series.lo === series.hi;
    const begin = raw && i > 0 && series.joined[i] ? series.k[i - 1]! + 1 : from;
    const to = !raw && next !== undefined && series.joined[i + 1] ? next : from + 1;
    const last = result.at(-1);
    if (last && last.token === cell.token && last.to >= begin) last.to = to;
    else result.push({ from: begin, to, token: cell.token, letter: cell.letter });
  }
  return result;
}
