import { render, screen, within } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { describe, expect, it, vi } from 'vitest';
import MetricsTable from './MetricsTable.svelte';
import ParametersTable from './ParametersTable.svelte';
import { compareAddress, readQuestion, splitIds, withBase, writeQuestion } from './question';
import QuestionForm from './QuestionForm.svelte';
import { anyOutside, chartRows, correlated, judgementRows, seriesOf, shortValue, valuesAt } from './read';
import type { ComparedRun, Comparison, Paired, Verdict } from './types';
import VerdictsTable from './VerdictsTable.svelte';

const run = (id: string): ComparedRun => ({ id, scenario: 'consensus', title: null, seed: 1, state: 'finished', parent: null, dt: 1, first: 0, last: 30, attack: 1, offset: 0 });
const verdict = (id: string, outside: [number, number][]): Verdict => ({ signal: 'lane.a.1.error', run: id, against: '1', ticks: 10, holds: outside.length === 0, inside: outside.length ? 0.8 : 1, first: outside[0]?.[0] ?? null, worst: 2.5, worst_at: 7, outside });
const paired = (id: string, lag1: number): Paired => ({ signal: 'lane.a.1.error', run: id, against: '1', mean: -0.25, se: 0.1, ci: [-0.5, 0], p: 0.03, n: 400, batches: 16, lag1 });

const comparison: Comparison = {
  runs: [run('1'), run('2'), run('3')],
  range: { from: 0, to: 3 },
  parameters: [{ path: 'lanes.a.params.tau', values: [0.01, 0.02, null] }],
  metrics: [
    { lane: 'a', node: null, name: 'rmse', variant: null, values: [2, 3, null], difference: [null, 1, null] },
    { lane: 'a', node: '4', name: 'rmse', variant: null, values: [1, 1, 1], difference: [null, 0, 0] },
  ],
  series: [],
  verdicts: [verdict('2', [[3, 4]]), verdict('3', [])],
  paired: [paired('2', 0.2), paired('3', 0.9)],
};

describe('the question in the address', () => {
  it('goes there and back, and leaves out what is as usual', () => {
    const asked = { ids: ['3', '5'], signals: 'lane.*.error', align: 'attack' as const, abs: '0.5', rel: '', shift: '2', from: '-5', to: '' };
    const written = writeQuestion(asked);
    const search = new URLSearchParams(Object.entries(written).filter((entry): entry is [string, string] => entry[1] !== null));
    expect(readQuestion(search)).toEqual(asked);
    expect([...search.keys()]).toEqual(['ids', 'signals', 'align', 'abs', 'shift', 'from']);
    expect(readQuestion(new URLSearchParams('ids=1,2&align=nonsense')).align).toBe('tick');
  });

  it('takes ids as they are typed, each once', () => {
    expect(splitIds(' 3, 5 8，9、3')).toEqual(['3', '5', '8', '9']);
    expect(splitIds('')).toEqual([]);
  });

  it('makes the oldest the base, until another is chosen', () => {
    expect(compareAddress(['10', '9', '2'])).toBe('/compare?ids=2,9,10');
    expect(withBase(['2', '9', '10'], '9')).toEqual(['9', '2', '10']);
  });
});

describe('the answer', () => {
  it('joins the stretches outside of all runs', () => {
    expect(anyOutside([verdict('2', [[8, 9], [1, 2]]), verdict('3', [[3, 4], [9, 12]])])).toEqual([[1, 4], [8, 12]]);
    expect(anyOutside([])).toEqual([]);
  });

  it('breaks lines where ticks are missing', () => {
    const series = seriesOf({ run: '1', bucket: 1, k: [0, 1, 2, 5], v: [1, null, 3, 4] });
    expect([...series.joined]).toEqual([0, 1, 1, 0]);
    expect([...series.lo].map((v) => (Number.isNaN(v) ? null : v))).toEqual([1, null, 3, 4]);
    expect(seriesOf(null).k.length).toBe(0);
  });

  it('gives each value at a tick, none beside it', () => {
    const runs = [{ run: '1', bucket: 1, k: [0, 2], v: [5, 6] }, { run: '2', bucket: 4, k: [0, 4], lo: [1, 2], hi: [3, 4] }, null];
    expect(valuesAt(runs, runs.map(seriesOf), 1)).toEqual([NaN, 3, NaN]);
    expect(valuesAt(runs, runs.map(seriesOf), 2)).toEqual([6, 3, NaN]);
  });

  it('saves raw ticks in one column a run, reduced ones in two', () => {
    const one = { run: '1', bucket: 1, k: [0, 1], v: [5, null] };
    const series = { signal: 'x', unit: '', kind: 'scalar' as const, labels: null, runs: [one, { run: '2', bucket: 1, k: [1, 2], v: [7, 8] }] };
    expect(chartRows(series, ['1', '2'])).toEqual({ columns: ['k', 'run 1', 'run 2'], rows: [[0, 5, ''], [1, '', 7], [2, '', 8]] });
    const reduced = chartRows({ ...series, runs: [one, { run: '2', bucket: 2, k: [0], lo: [1], hi: [4] }] }, ['1', '2']);
    expect(reduced.columns).toEqual(['k', 'run 1 least', 'run 1 greatest', 'run 2 least', 'run 2 greatest']);
    expect(reduced.rows[0]).toEqual([0, 5, 5, 1, 4]);
  });

  it('warns of batches that still follow one another: beyond 2 / sqrt(16)', () => {
    expect(correlated(paired('2', 0.49))).toBe(false);
    expect(correlated(paired('2', 0.51))).toBe(true);
    expect(correlated({ ...paired('2', 1), batches: undefined })).toBe(false);
  });

  it('puts every figure into one file', () => {
    const { columns, rows } = judgementRows(comparison);
    expect(rows.every((row) => row.length === columns.length)).toBe(true);
    expect(rows[0]).toEqual(['signal', 'lane.a.1.error', '2', '1', 10, 0.8, 3, 2.5, 7, -0.25, 0.1, -0.5, 0, 0.03, 400]);
    expect(rows.filter((row) => row[0] === 'metric')).toHaveLength(4);
  });

  it('shortens what is long', () => {
    expect(shortValue({ a: 1 })).toBe('{"a":1}');
    expect(shortValue('x'.repeat(100)).length).toBe(48);
  });
});

describe('tables', () => {
  it('show differing parameters, and that one is not there', () => {
    render(ParametersTable, { comparison });
    const cells = within(screen.getByRole('row', { name: /tau/ })).getAllByRole('cell');
    expect(cells.map((cell) => cell.textContent)).toEqual(['0.01', '0.02', 'not there']);
  });

  it('show verdicts with their intervals, and where an interval is too narrow', () => {
    render(VerdictsTable, { comparison });
    const [, first, second] = screen.getAllByRole('row');
    expect(first!.textContent).toContain('outside');
    expect(first!.textContent).toContain('80.0 %');
    expect(first!.textContent).toContain('[-0.500, 0]');
    expect(first!.textContent).not.toContain('too narrow');
    expect(second!.textContent).toContain('within');
    expect(second!.textContent).toContain('too narrow');
  });

  it('show the nodes where they are asked for, and that one pair of runs gives no interval', async () => {
    render(MetricsTable, { comparison });
    expect(screen.getAllByRole('row')).toHaveLength(2);
    expect(screen.getByText(/no interval for a metric/)).toBeTruthy();
    await userEvent.click(screen.getByRole('checkbox', { name: 'Nodes too' }));
    expect(screen.getAllByRole('row')).toHaveLength(3);
  });

  it('show pairs over seeds', () => {
    const seeds: Paired = { metric: { lane: 'a', node: null, name: 'rmse', variant: null }, against: '3', pairs: [['1', '3']], mean: 1, se: 0.5, ci: [-5, 7], p: 0.5, n: 2 };
    render(MetricsTable, { comparison: { ...comparison, paired: [seeds] } });
    expect(screen.getByText(/\+1\.00 \[-5\.00, 7\.00\], n 2/)).toBeTruthy();
  });
});

describe('the form', () => {
  it('asks everything at once and offers what the base has', async () => {
    const onask = vi.fn();
    const question = readQuestion(new URLSearchParams('ids=1,2'));
    render(QuestionForm, { question, names: ['lane.a.1.error', 'truth.x', ...Array.from({ length: 65 }, (_, i) => `link.${i}-0.state`)], onask });
    expect(screen.queryByRole('button', { name: 'Link states' })).toBeNull();
    await userEvent.type(screen.getByRole('textbox', { name: 'Absolute tolerance' }), '0.5');
    await userEvent.selectOptions(screen.getByRole('combobox', { name: 'Align by' }), 'attack');
    await userEvent.click(screen.getByRole('button', { name: 'Compare' }));
    expect(onask).toHaveBeenLastCalledWith({ ...question, abs: '0.5', align: 'attack' });
    await userEvent.click(screen.getByRole('button', { name: 'Errors' }));
    expect(onask).toHaveBeenLastCalledWith({ ...question, abs: '0.5', align: 'attack', signals: 'lane.*.error' });
  });
});
