/// A panel's data as rows, for those who cannot or do not want to read a drawing.
import { formatNumber } from '../../i18n/format.svelte';
import type { Series } from '../../data/series';

export interface TableData {
  columns: string[];
  rows: string[][];
  /** Rows there are in all. */
  total: number;
}

export const tableRows = 100;

/** The newest rows of several signals over one window. Reduced samples show both extremes. */
export function seriesTable(columns: readonly { name: string; series: Series; text?: (value: number) => string }[], from: number, to: number): TableData {
  const ticks = new Set<number>();
  for (const { series } of columns) for (const k of series.k) if (k >= from && k <= to) ticks.add(k);
  const all = [...ticks].sort((a, b) => b - a);
  const rows = all.slice(0, tableRows).map((k) => [String(k), ...columns.map(({ series, text }) => cell(series, k, text ?? ((value) => formatNumber(value, 4))))]);
  return { columns: ['k', ...columns.map((column) => column.name)], rows, total: all.length };
}

function cell(series: Series, k: number, text: (value: number) => string): string {
  let low = 0;
  let high = series.k.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (series.k[middle]! < k) low = middle + 1;
    else high = middle;
  }
  if (series.k[low] !== k) return '';
  const lo = series.lo[low]!;
  const hi = series.hi[low]!;
  if (Number.isNaN(hi)) return '–';
  return lo === hi ? text(hi) : `${text(lo)} … ${text(hi)}`;
}
