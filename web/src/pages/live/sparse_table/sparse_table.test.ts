import { render, screen, within } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Metric, RunDetail } from '../../../api/types';
import { language } from '../../../i18n/i18n.svelte';
import { liveKey } from '../context';
import { makeModel } from '../model';
import { LiveView } from '../view.svelte';
import { hasTable, lateShare, printedApplies, table2, table2Rows } from './assemble';
import { printed, printedNodes } from './printed';
import Table2Panel from './Table2Panel.svelte';

const nodes = ['1', '2', '3', '4', '5'];
const metric = (lane: string, node: string | null, value: number | null, name = 'mse_px'): Metric => ({ lane, node, name, variant: null, value });
const metrics: Metric[] = [
  ...nodes.map((node, i) => metric('omp_game', node, [0.08, 0.04, 0.7, 1.1, 0.003][i]!)),
  ...nodes.map((node) => metric('omp_game', node, 1e-4, 'mse_px_0_9s')),
  ...nodes.map((node) => metric('pred', node, 0.005)),
  metric('dkf', '1', null),
  metric('dkf', '2', 13),
  metric('omp_game', null, 99),
];
const run = {
  id: '7', seed: 3, family: 'sparse', view: {}, metrics, document: { metrics: { mse: { mse_px: { component: 'px' } } } }, progress: { k: 200 },
  world: { nodes: nodes.map((id) => ({ id, position: null })), links: [], lanes: [{ id: 'pred', method: 'dead_reckoning', adversary: false }, { id: 'omp_game', method: 'omp_game', adversary: true }, { id: 'dkf', method: 'kalman_consensus', adversary: true }], state: [] },
} as unknown as RunDetail;
const model = makeModel(run, []);

describe('table 2', () => {
  it('has a row a lane, the reference last, and a figure a node', () => {
    const table = table2(model.lanes, nodes, metrics, 'mse_px');
    expect(table.rows.map((row) => [row.lane, row.algorithm, row.reference])).toEqual([['omp_game', 'A1', false], ['dkf', 'A3', false], ['pred', null, true]]);
    expect(table.rows[0]!.cells.map((cell) => cell.value)).toEqual([0.08, 0.04, 0.7, 1.1, 0.003]);
    expect(table.rows[1]!.cells.map((cell) => cell.value)).toEqual([null, 13, null, null, null]);
  });

  it('marks the least of each column, the reference included, and counts where it wins', () => {
    const table = table2(model.lanes, nodes, metrics, 'mse_px');
    expect(table.rows[0]!.cells.map((cell) => cell.best)).toEqual([false, false, false, false, true]);
    expect(table.rows[2]!.cells.map((cell) => cell.best)).toEqual([true, true, true, true, false]);
    expect(table.won).toBe(4);
  });

  it('calls nothing the best while there is nothing to compare', () => {
    const early = table2(model.lanes, nodes, metrics, 'mse_px_0_9s');
    expect(early.rows.flatMap((row) => row.cells).some((cell) => cell.best)).toBe(false);
    expect(early.won).toBeNull();
    expect(table2(model.lanes, nodes, [], 'mse_px').rows.every((row) => row.cells.every((cell) => cell.value === null))).toBe(true);
  });

  it('applies to runs that are asked for the figure, also before it is there', () => {
    expect(hasTable({ ...run, metrics: [] })).toBe(true);
    expect(hasTable({ ...run, document: {} })).toBe(true);
    expect(hasTable({ ...run, document: {}, metrics: [metric('a', null, 1)] })).toBe(false);
  });

  it('shows the printed figures only beside what they can be read with', () => {
    expect(printedApplies(nodes, 'mse_px')).toBe(true);
    expect(printedApplies(nodes, 'mse_px_0_9s')).toBe(false);
    expect(printedApplies(nodes.slice(0, 4), 'mse_px')).toBe(false);
    for (const row of printed) expect(row.values).toHaveLength(printedNodes.length);
  });

  it('tells how much of the error came late', () => {
    const late = lateShare(model.lanes[1]!, nodes, metrics, 200)!;
    expect(late.node).toBe('4');
    expect(late.share).toBeCloseTo(1 - (1e-4 * 179) / (1.1 * 200), 12);
    expect(lateShare(model.lanes[1]!, nodes, metrics, 179)).toBeNull();
    expect(lateShare(model.lanes[0]!, nodes, metrics, 200)).toBeNull();
  });

  it('goes to CSV at full precision, the source named on its rows', () => {
    const { columns, rows } = table2Rows(table2(model.lanes, nodes, metrics, 'mse_px'), 'mse_px', 'printed in the source');
    expect(columns).toEqual(['lane', 'algorithm', 'figure', 'node 1', 'node 2', 'node 3', 'node 4', 'node 5']);
    expect(rows).toHaveLength(8);
    expect(rows[1]).toEqual(['dkf', 'A3', 'mse_px', '', 13, '', '', '']);
    expect(rows[3]).toEqual(['omp_game', 'A1', 'printed in the source', '0.0724', '0.0150', '0.0724', '1.3807', '0.0054']);
  });
});

describe('its panel', () => {
  beforeEach(() => {
    history.replaceState(null, '', '/live/7');
    language.set('en');
  });

  it('switches the span, chooses a lane, and says what the whole-run mean is worth', async () => {
    const view = new LiveView();
    const session = { id: '7', run, model, source: null, status: { stale: false }, take: vi.fn() };
    render(Table2Panel, { context: new Map([[liveKey, { session, view }]]) });
    const row = screen.getByRole('row', { name: /^omp game A1/ });
    expect(within(row).getByText('0.0400').classList.contains('best')).toBe(false);
    expect(within(row).getByText('0.00300').classList.contains('best')).toBe(true);
    expect(screen.getByText('40.6553')).toBeTruthy();
    expect(screen.getByText(/pred ignores every sensor/).textContent).toMatch(/best at 4 of 5 nodes/);
    await userEvent.click(screen.getByRole('button', { name: '0–9 s' }));
    expect(screen.queryByText('40.6553')).toBeNull();
    expect(screen.getByText(/prints the whole run only/)).toBeTruthy();
    await userEvent.click(screen.getByRole('button', { name: /^dkf/ }));
    expect(view.lane).toBe('dkf');
  });
});
