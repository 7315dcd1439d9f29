/// What GET /api/v1/compare answers, as docs/api.md says.
import type { Localised, RunState } from '../../api/types';

export interface ComparedRun {
  id: string;
  scenario: string;
  title: Localised | null;
  seed: number | null;
  state: RunState;
  parent: { run: string; k: number } | null;
  dt: number;
  /** Ticks there are; null: none. */
  first: number | null;
  last: number | null;
  /** Tick at which its first attack begins. */
  attack: number | null;
  /** Tick that the comparison calls 0. */
  offset: number;
}

export type Drawn = { run: string; bucket: number; k: number[] } & ({ v: (number | null)[] } | { lo: (number | null)[]; hi: (number | null)[] });

export interface ComparedSeries {
  signal: string;
  unit: string;
  kind: 'scalar' | 'bool' | 'category';
  labels: Record<string, string> | null;
  /** In the order of the runs; null where one does not have it. */
  runs: (Drawn | null)[];
}

export interface Verdict {
  signal: string;
  run: string;
  against: string;
  ticks: number;
  holds: boolean;
  /** Share of the ticks, null where there is none. */
  inside: number | null;
  first: number | null;
  worst: number | null;
  worst_at: number | null;
  /** Ticks from and to, both included. */
  outside: [number, number][];
}

export interface MetricName {
  lane: string;
  node: string | null;
  name: string;
  variant: string | null;
}

export interface ComparedMetric extends MetricName {
  values: (number | boolean | null)[];
  difference: (number | null)[];
}

export interface Paired {
  signal?: string;
  run?: string;
  metric?: MetricName;
  against: string;
  pairs?: [string, string][];
  mean: number | null;
  se: number | null;
  ci: [number, number] | null;
  p: number | null;
  n: number;
  batches?: number;
  lag1?: number | null;
}

export interface Comparison {
  runs: ComparedRun[];
  /** null: no run has samples there. */
  range: { from: number; to: number } | null;
  parameters: { path: string; values: unknown[] }[];
  metrics: ComparedMetric[];
  series: ComparedSeries[];
  verdicts: Verdict[];
  paired: Paired[];
}
