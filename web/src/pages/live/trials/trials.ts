/// Rates over the finished runs of one scenario in this log, in the order in which they were made.
import type { RunItem } from '../../../api/types';
import { runMetric } from '../metrics';

/** Of a run that was made of the same document, ran to its end, and was left alone while it ran. */
export function isTrial(run: RunItem, hash: string): boolean {
  return run.document_hash === hash && run.state === 'finished' && run.changes === 0 && run.input === 'simulate';
}

/** One a seed: a run repeated with the same seed is the same trial again. */
export function trialsOf(runs: readonly RunItem[], hash: string): RunItem[] {
  const seeds = new Set<number>();
  return runs
    .filter((run) => isTrial(run, hash))
    .toSorted((a, b) => Number(a.id) - Number(b.id))
    .filter((run) => !seeds.has(run.seed) && seeds.add(run.seed));
}

export function valuesOf(trials: readonly RunItem[], lane: string, name: string): number[] {
  return trials.flatMap((run) => {
    const value = runMetric(run.metrics, lane, name);
    return typeof value === 'number' && Number.isFinite(value) ? [value] : [];
  });
}

/** Mean of the first 1, 2, 3, … values. */
export function runningMean(values: readonly number[]): number[] {
  let sum = 0;
  return values.map((value, i) => (sum += value) / (i + 1));
}

export interface Mean {
  mean: number | null;
  /** Standard error; null below two values. */
  error: number | null;
  count: number;
}

export function meanOf(values: readonly number[]): Mean {
  const count = values.length;
  if (!count) return { mean: null, error: null, count };
  const mean = values.reduce((sum, value) => sum + value, 0) / count;
  if (count < 2) return { mean, error: null, count };
  const variance = values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (count - 1);
  return { mean, error: Math.sqrt(variance / count), count };
}

/** Seeds for `count` more runs: the smallest that none of the runs has. */
export function freeSeeds(taken: readonly number[], count: number): number[] {
  const known = new Set(taken);
  const seeds: number[] = [];
  for (let seed = 1; seeds.length < count; seed++) if (!known.has(seed)) seeds.push(seed);
  return seeds;
}
