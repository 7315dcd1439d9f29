/// What the run's metrics say of a lane's reconstructions: windows that were attacked throughout in one way, by type.
import type { Metric } from '../../../api/types';

export interface Quality {
  type: string;
  /** Share of windows whose support was found exactly. */
  exact: number;
  /** Share of the true entries that were found. */
  hit: number;
  /** False entries per window. */
  falses: number;
}

export function qualityOf(metrics: readonly Metric[], lane: string): Quality[] {
  const of = (name: string, type: string): number => {
    const found = metrics.find((metric) => metric.lane === lane && metric.name === name && metric.variant === type && (metric.node === null || metric.node === ''));
    return typeof found?.value === 'number' ? found.value : NaN;
  };
  const types = new Set(metrics.filter((metric) => metric.lane === lane && metric.name === 'omp_exact' && metric.variant).map((metric) => metric.variant!));
  return [...types]
    .sort()
    .map((type) => ({ type, exact: of('omp_exact', type), hit: of('omp_hit_rate', type), falses: of('omp_false_entries', type) }))
    .filter(({ exact }) => Number.isFinite(exact));
}

/** A share as per cent: whole where that says enough, never 0 or 100 unless it is. */
export function percent(share: number): string {
  if (!Number.isFinite(share)) return '–';
  const value = 100 * share;
  if (value === 0 || value === 100) return `${value} %`;
  if (value < 1) return value < 0.1 ? '< 0.1 %' : `${value.toFixed(1)} %`;
  if (value > 99) return value > 99.9 ? '> 99.9 %' : `${value.toFixed(1)} %`;
  return `${Math.round(value)} %`;
}
