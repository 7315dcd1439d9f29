/// A lane's figures of detection and estimation, a row each, from the run's metrics as they stand.
import type { Metric } from '../../../api/types';
import { runMetric } from '../metrics';
import type { LaneModel } from '../model';

export const columns = ['tpr', 'fpr', 'accuracy', 'event', 'event_without_attack', 'delay', 'longest', 'rmse_state', 'peak_error'] as const;
export type Column = (typeof columns)[number];

export interface RateRow {
  lane: string;
  token: string;
  dash: number[];
  values: Record<Column, number | null>;
}

export interface Order {
  column: Column | null;
  falling: boolean;
}

export function rateRows(lanes: readonly LaneModel[], metrics: readonly Metric[]): RateRow[] {
  return lanes.map((lane) => ({
    lane: lane.id,
    token: lane.token,
    dash: lane.dash,
    values: Object.fromEntries(columns.map((column) => [column, numeric(runMetric(metrics, lane.id, column))])) as Record<Column, number | null>,
  }));
}

function numeric(value: number | boolean | null): number | null {
  return typeof value === 'boolean' ? Number(value) : value;
}

/** What is missing comes last, whichever way; equal ones keep the document's order. */
export function sorted(rows: readonly RateRow[], { column, falling }: Order): RateRow[] {
  if (column === null) return [...rows];
  const at = (row: RateRow): number | null => row.values[column];
  return rows.toSorted((a, b) => {
    const [x, y] = [at(a), at(b)];
    if (x === null || y === null) return Number(x === null) - Number(y === null);
    return falling ? y - x : x - y;
  });
}

/** Great first where great is good; again: the other way; then the document's order. */
export function nextOrder(now: Order, column: Column): Order {
  const good = column === 'tpr' || column === 'accuracy' || column === 'longest';
  if (now.column !== column) return { column, falling: good };
  return now.falling === good ? { column, falling: !good } : { column: null, falling: false };
}

/** At full precision. */
export function csvRows(rows: readonly RateRow[], quiet: number | null, word: string): { columns: string[]; rows: (string | number)[][] } {
  const lines: (string | number)[][] = rows.map((row) => [row.lane, ...columns.map((column) => row.values[column] ?? '')]);
  if (quiet !== null) lines.push([word, ...columns.map((column) => (column === 'accuracy' ? quiet : ''))]);
  return { columns: ['lane', ...columns], rows: lines };
}

export function cellText(column: Column, value: number | null, format: (value: number | null) => string, words: { yes: string; no: string }): string {
  if (value === null) return format(null);
  if (column === 'event' || column === 'event_without_attack') return value > 0.5 ? words.yes : words.no;
  if (column === 'delay' || column === 'longest') return String(Math.round(value));
  return column === 'tpr' || column === 'fpr' || column === 'accuracy' ? value.toFixed(3) : format(value);
}
