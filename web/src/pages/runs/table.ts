import type { Metric, RunItem } from '../../api/types';

/** Fields the list can be sorted by with a click; the metric's depends on the runs shown. */
export type SortField = 'id' | 'state' | 'scenario' | 'seed' | 'started' | 'ended' | string;

export interface Sort {
  field: SortField;
  falling: boolean;
}

/** The API's `sort`: "-started". Empty text is newest first. */
export function readSort(text: string | null): Sort {
  if (!text) return { field: 'id', falling: true };
  return text.startsWith('-') ? { field: text.slice(1), falling: true } : { field: text, falling: false };
}

export function writeSort(sort: Sort): string {
  if (sort.field === 'id' && sort.falling) return '';
  return (sort.falling ? '-' : '') + sort.field;
}

/** A click on a column: falling first, then rising, then newest first again. */
export function nextSort(now: Sort, field: SortField): Sort {
  if (now.field !== field) return { field, falling: true };
  return now.falling ? { field, falling: false } : { field: 'id', falling: true };
}

export function ariaSort(now: Sort, field: SortField): 'ascending' | 'descending' | undefined {
  if (now.field !== field) return undefined;
  return now.falling ? 'descending' : 'ascending';
}

/** Which rows of a long list are in the document, with some to spare above and below. */
export interface Window {
  first: number;
  /** One past the last. */
  end: number;
  /** Height of what is left out above and below, px. */
  above: number;
  below: number;
}

export function windowOf(count: number, rowHeight: number, scrollTop: number, height: number, spare = 8): Window {
  const first = Math.min(Math.max(0, Math.floor(scrollTop / rowHeight) - spare), Math.max(0, count - 1));
  const end = Math.min(count, Math.ceil((scrollTop + Math.max(height, rowHeight)) / rowHeight) + spare);
  return { first, end, above: first * rowHeight, below: (count - end) * rowHeight };
}

/** The figure over the whole network that says how well each lane did: its position RMSE, else its first error figure. */
export function errorsByLane(run: RunItem): { lane: string; name: string; value: number | null }[] {
  const whole = run.metrics.filter((metric) => metric.node === null && typeof metric.value !== 'boolean');
  const lanes = [...new Set(whole.map((metric) => metric.lane))];
  return lanes.flatMap((lane) => {
    const own = whole.filter((metric) => metric.lane === lane);
    const chosen = own.find((metric) => metric.name === 'rmse_position') ?? own.find((metric) => /^(rmse|rms|mse)_/.test(metric.name));
    return chosen ? [{ lane, name: chosen.name, value: numberOf(chosen) }] : [];
  });
}

function numberOf(metric: Metric): number | null {
  return typeof metric.value === 'number' ? metric.value : null;
}

/** Seconds from its start to its end, to `now` while it goes on; null before it started. */
export function durationOf(run: RunItem, now: number): number | null {
  if (!run.started) return null;
  const end = run.ended ? Date.parse(run.ended) : now;
  const seconds = (end - Date.parse(run.started)) / 1000;
  return Number.isFinite(seconds) ? Math.max(0, seconds) : null;
}

/** The list with one run replaced by its newer self; unchanged where it is not in the list. */
export function replaced(items: readonly RunItem[], run: RunItem): RunItem[] {
  return items.map((item) => (item.id === run.id ? run : item));
}

/** A further page behind what is there; what came twice (a run was deleted in between) is kept once. */
export function appended(items: readonly RunItem[], page: readonly RunItem[]): RunItem[] {
  const known = new Set(items.map((item) => item.id));
  return [...items, ...page.filter((item) => !known.has(item.id))];
}
