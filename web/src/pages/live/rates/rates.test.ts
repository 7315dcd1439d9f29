import { describe, expect, it } from 'vitest';
import type { Metric } from '../../../api/types';
import { formatNumber } from '../../../i18n/format.svelte';
import type { LaneModel } from '../model';
import { cellText, columns, csvRows, nextOrder, rateRows, sorted } from './rates';

const lane = (id: string): LaneModel => ({ id, token: 'lane-0', dash: [] }) as unknown as LaneModel;
const metric = (id: string, name: string, value: number | boolean | null, changes: Partial<Metric> = {}): Metric => ({ lane: id, node: null, name, variant: null, value, ...changes });
const rows = rateRows(
  [lane('a'), lane('b'), lane('ufir')],
  [metric('a', 'tpr', 0.2), metric('b', 'tpr', 0.9), metric('a', 'accuracy', 0.7), metric('b', 'accuracy', 0.7), metric('b', 'delay', 3), metric('ufir', 'rmse_state', 0.5), metric('ufir', 'rmse_state', 9, { variant: 'x1' }), metric('a', 'rmse_state', 0.6), metric('a', 'event', true)],
);
const order = (column: (typeof columns)[number] | null, falling: boolean): string[] => sorted(rows, { column, falling }).map((row) => row.lane);

describe('rates', () => {
  it('have a row a lane, of figures over the whole network, and a gap where there is none', () => {
    expect(rows.map((row) => row.values.tpr)).toEqual([0.2, 0.9, null]);
    expect(rows[2]!.values.rmse_state).toBe(0.5);
    expect(rows[0]!.values.event).toBe(1);
  });

  it('are sorted with what is missing last, whichever way', () => {
    expect(order('tpr', true)).toEqual(['b', 'a', 'ufir']);
    expect(order('tpr', false)).toEqual(['a', 'b', 'ufir']);
    expect(order('rmse_state', false)).toEqual(['ufir', 'a', 'b']);
    expect(order('accuracy', true)).toEqual(['a', 'b', 'ufir']);
    expect(order(null, true)).toEqual(['a', 'b', 'ufir']);
  });

  it('begin with the good end of a column, and come back to the document’s order', () => {
    const first = nextOrder({ column: null, falling: false }, 'tpr');
    expect(first).toEqual({ column: 'tpr', falling: true });
    expect(nextOrder(first, 'tpr')).toEqual({ column: 'tpr', falling: false });
    expect(nextOrder(nextOrder(first, 'tpr'), 'tpr').column).toBeNull();
    expect(nextOrder(first, 'fpr')).toEqual({ column: 'fpr', falling: false });
  });

  it('are copied at full precision, with what saying nothing would reach', () => {
    const made = csvRows(rows, 220 / 300, 'always');
    expect(made.columns).toEqual(['lane', ...columns]);
    expect(made.rows).toHaveLength(4);
    expect(made.rows[1]!.slice(0, 2)).toEqual(['b', 0.9]);
    expect(made.rows[3]![3]).toBe(220 / 300);
    expect(csvRows(rows, null, 'always').rows).toHaveLength(3);
  });

  it('are words, counts or shares', () => {
    const words = { yes: 'yes', no: 'no' };
    expect([cellText('event', 1, formatNumber, words), cellText('event', 0, formatNumber, words), cellText('delay', 3, formatNumber, words), cellText('tpr', 0.98765, formatNumber, words), cellText('peak_error', 0.8592, formatNumber, words), cellText('tpr', null, formatNumber, words)]).toEqual(['yes', 'no', '3', '0.988', '0.859', '–']);
  });
});
