/// The run's figures of attack, fault and state errors, per lane and subsystem, beside the size of what was to be found.
import type { Metric, RunDetail } from '../../../api/types';
import type { Series } from '../../../data/series';
import type { SubsystemModel } from './subsystems';

export const figureNames = ['rms_attack_error', 'rms_fault_error', 'rms_state_error'] as const;
export type FigureName = (typeof figureNames)[number];

export function nodeMetric(metrics: readonly Metric[], lane: string, node: string, name: string): number | null {
  const value = metrics.find((metric) => metric.lane === lane && String(metric.node) === node && metric.name === name && !metric.variant)?.value;
  return typeof value === 'number' && Number.isFinite(value) ? value : null;
}

/** Ticks that the figures count, (from, to], as the scenario's metrics say by the first and the last; all of them where it says nothing. */
export function windowOf(run: Pick<RunDetail, 'document' | 'progress'>): { from: number; to: number; seconds: [number, number] } {
  const window = (run.document?.metrics as { window?: { from?: unknown; to?: unknown } } | undefined)?.window;
  const time = run.document?.time as { steps?: unknown } | undefined;
  const dt = run.progress.dt || 1;
  const last = typeof time?.steps === 'number' ? time.steps : run.progress.k;
  const from = typeof window?.from === 'number' ? Math.max(0, window.from - 1) : 0;
  const to = typeof window?.to === 'number' ? window.to : last;
  return { from, to, seconds: [from * dt, to * dt] };
}

/** Root of the mean square over the points of (from, to]. Of a point that stands for several ticks its line from least to greatest counts. */
export function rmsOf(series: Series, from: number, to: number): number | null {
  let sum = 0;
  let count = 0;
  for (let i = 0; i < series.k.length; i++) {
    const k = series.k[i]!;
    const [lo, hi] = [series.lo[i]!, series.hi[i]!];
    if (k <= from || k > to || Number.isNaN(lo + hi)) continue;
    sum += (lo * lo + lo * hi + hi * hi) / 3;
    count++;
  }
  return count ? Math.sqrt(sum / count) : null;
}

/** True attacks and faults whose size is wanted, by subsystem. */
export function trueSignals(subsystems: readonly SubsystemModel[]): string[] {
  return subsystems.flatMap(({ channels }) => channels.flatMap(({ truth }) => (truth ? [truth] : [])));
}

/** Size of all attacks (or faults) of a subsystem together, the norm over its channels as the run's figures take it; null while it is not known. */
export function sizeOf(subsystem: SubsystemModel, kind: 'attack' | 'fault', sizes: ReadonlyMap<string, number>): number | null {
  const own = subsystem.channels.filter((channel) => channel.kind === kind && channel.truth);
  if (!own.length || !own.every(({ truth }) => sizes.has(truth!))) return null;
  return Math.hypot(...own.map(({ truth }) => sizes.get(truth!)!));
}
