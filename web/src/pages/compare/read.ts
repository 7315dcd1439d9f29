/// The server's answer as the page draws and lists it.
import { samplesSeries, emptySeries, valueAt, type Series } from '../../data/series';
import { laneDash, laneToken } from '../../chart/colours';
import type { ComparedMetric, ComparedSeries, Comparison, Drawn, MetricName, Paired, Verdict } from './types';

export interface RunLook {
  token: string;
  dash: number[];
  width: number;
}

/** A run's colour and dash, by its place; the base is drawn wider. */
export function runLook(index: number): RunLook {
  return { token: laneToken(index), dash: laneDash(index), width: index === 0 ? 2.2 : 1.5 };
}

export function seriesOf(drawn: Drawn | null): Series {
  if (!drawn) return emptySeries;
  const series = 'v' in drawn ? { signal: '', v: drawn.v } : { signal: '', lo: drawn.lo, hi: drawn.hi };
  return samplesSeries({ k: drawn.k, series: [series] }).get('') ?? emptySeries;
}

export function verdictsOf(comparison: Comparison, signal: string): Verdict[] {
  return comparison.verdicts.filter((verdict) => verdict.signal === signal);
}

export function pairedOf(comparison: Comparison, verdict: Verdict): Paired | undefined {
  return comparison.paired.find((paired) => paired.signal === verdict.signal && paired.run === verdict.run);
}

/** Batch means that still follow one another: the interval is narrower than it should be. */
export function correlated(paired: Paired): boolean {
  return paired.batches !== undefined && typeof paired.lag1 === 'number' && paired.lag1 > 2 / Math.sqrt(paired.batches);
}

export function metricName(metric: MetricName): string {
  return [metric.lane, metric.node, metric.name, metric.variant].filter((part) => part !== null && part !== '').join(' ');
}

/** The paired difference over seeds of one metric, one a document that differs from the base's. */
export function seedPairs(comparison: Comparison, metric: ComparedMetric): Paired[] {
  const name = metricName(metric);
  return comparison.paired.filter((paired) => paired.metric !== undefined && metricName(paired.metric) === name && paired.metric.node === metric.node);
}

/** Ticks at which any run is outside, joined where they overlap or touch. */
export function anyOutside(verdicts: readonly Verdict[]): [number, number][] {
  const all = verdicts.flatMap((verdict) => verdict.outside).sort((a, b) => a[0] - b[0]);
  const joined: [number, number][] = [];
  for (const [from, to] of all) {
    const last = joined[joined.length - 1];
    if (last && from <= last[1] + 1) last[1] = Math.max(last[1], to);
    else joined.push([from, to]);
  }
  return joined;
}

/** A parameter's value in few characters. */
export function shortValue(value: unknown, most = 48): string {
  const text = typeof value === 'string' ? value : JSON.stringify(value);
  return text.length > most ? `${text.slice(0, most - 1)}…` : text;
}

/** One row a tick that any run has: k, then a value a run. Of reduced samples the least and the greatest. */
export function chartRows(series: ComparedSeries, ids: readonly string[]): { columns: string[]; rows: (string | number)[][] } {
  const all = series.runs.map(seriesOf);
  const raw = series.runs.every((run) => run === null || 'v' in run);
  const ticks = [...new Set(all.flatMap((one) => [...one.k]))].sort((a, b) => a - b);
  const columns = ['k', ...ids.flatMap((id) => (raw ? [`run ${id}`] : [`run ${id} least`, `run ${id} greatest`]))];
  const exact = (values: Float64Array, one: Series, k: number): string | number => {
    const i = one.k.indexOf(k);
    return i < 0 || Number.isNaN(values[i]!) ? '' : values[i]!;
  };
  return { columns, rows: ticks.map((k) => [k, ...all.flatMap((one) => (raw ? [exact(one.lo, one, k)] : [exact(one.lo, one, k), exact(one.hi, one, k)]))]) };
}

/** Each run's value at a tick; of reduced samples the greatest of its bucket. */
export function valuesAt(runs: readonly (Drawn | null)[], all: readonly Series[], k: number): number[] {
  return all.map((series, i) => valueAt(series, k, (runs[i]?.bucket ?? 1) - 1));
}

/** Verdicts and paired differences as rows of a file. */
export function judgementRows(comparison: Comparison): { columns: string[]; rows: (string | number)[][] } {
  const columns = ['kind', 'name', 'run', 'against', 'ticks', 'inside', 'first_outside', 'worst', 'worst_at', 'mean', 'se', 'ci_low', 'ci_high', 'p', 'n'];
  const figures = (paired: Paired | undefined): (string | number)[] => [paired?.mean, paired?.se, paired?.ci?.[0], paired?.ci?.[1], paired?.p, paired?.n].map((value) => value ?? '');
  const signals = comparison.verdicts.map((one) => ['signal', one.signal, one.run, one.against, one.ticks, one.inside ?? '', one.first ?? '', one.worst ?? '', one.worst_at ?? '', ...figures(pairedOf(comparison, one))]);
  const base = comparison.runs[0]?.id ?? '';
  const metrics = comparison.metrics.flatMap((metric) =>
    comparison.runs.slice(1).map((run, i) => ['metric', metricName(metric), run.id, base, '', '', '', '', '', metric.difference[i + 1] ?? '', '', '', '', '', '']),
  );
  const seeds = comparison.paired.flatMap((one) => (one.metric ? [['metric over seeds', metricName(one.metric), one.against, base, '', '', '', '', '', ...figures(one)]] : []));
  return { columns, rows: [...signals, ...metrics, ...seeds] };
}
