import type { Metric } from '../../api/types';

/** A run's figure over the whole network of a lane, or null where it has none. */
export function runMetric(metrics: readonly Metric[], lane: string, name: string): number | boolean | null {
  const found = metrics.find((metric) => metric.lane === lane && metric.name === name && (metric.node === null || metric.node === undefined || metric.node === '') && !metric.variant);
  return found?.value ?? null;
}
