/// Table 2 of this run: a row a lane, a column a node, from the run's metrics as they stand.
import type { Metric, RunDetail } from '../../../api/types';
import type { LaneModel } from '../model';
import { printed, printedNodes } from './printed';

export type MetricName = 'mse_px' | 'mse_px_0_9s';

export interface Cell {
  /** null: the run has no such figure, or not yet. */
  value: number | null;
  /** The least of its column. */
  best: boolean;
}

export interface Row {
  lane: string;
  token: string;
  dash: number[];
  /** The source's number of the algorithm, e.g. A1; null: not one of its five. */
  algorithm: string | null;
  /** It uses no sensor: what every other row has to beat. */
  reference: boolean;
  cells: Cell[];
}

export interface Table2 {
  nodes: string[];
  rows: Row[];
  /** Columns in which the reference is the best; null: no reference, or nothing to compare yet. */
  won: number | null;
}

/** Whether a run makes the figure: its document asks for it, or it is there already. */
export function hasTable(run: RunDetail): boolean {
  const asked = (run.document?.metrics as { mse?: Record<string, unknown> } | undefined)?.mse;
  return asked?.mse_px !== undefined || (run.metrics ?? []).some((metric) => metric.name === 'mse_px' && metric.node !== null);
}

export function table2(lanes: readonly LaneModel[], nodes: readonly string[], metrics: readonly Metric[], name: MetricName): Table2 {
  const values = new Map<string, number>();
  for (const metric of metrics) {
    if (metric.name === name && metric.node !== null && typeof metric.value === 'number' && Number.isFinite(metric.value)) values.set(`${metric.lane} ${metric.node}`, metric.value);
  }
  const ordered = [...lanes.filter((lane) => !ignoresSensors(lane)), ...lanes.filter(ignoresSensors)];
  const rows = ordered.map((lane): Row => ({
    lane: lane.id,
    token: lane.token,
    dash: lane.dash,
    algorithm: printed.find((one) => one.lane === lane.id)?.name ?? null,
    reference: ignoresSensors(lane),
    cells: nodes.map((node) => ({ value: values.get(`${lane.id} ${node}`) ?? null, best: false })),
  }));
  nodes.forEach((_, column) => markBest(rows.map((row) => row.cells[column]!)));
  const reference = rows.find((row) => row.reference);
  const compared = rows.length > 1 && reference?.cells.some((cell) => cell.value !== null);
  return { nodes: [...nodes], rows, won: compared ? reference!.cells.filter((cell) => cell.best).length : null };
}

function ignoresSensors(lane: LaneModel): boolean {
  return lane.method === 'dead_reckoning';
}

/** Equal ones share it; nothing is the best of one. */
function markBest(cells: readonly Cell[]): void {
  const known = cells.filter((cell) => cell.value !== null);
  if (known.length < 2) return;
  const least = Math.min(...known.map((cell) => cell.value!));
  for (const cell of known) cell.best = cell.value === least;
}

/** The source's figures speak of five nodes over the whole run: beside anything else they would say nothing. */
export function printedApplies(nodes: readonly string[], name: MetricName): boolean {
  return name === 'mse_px' && nodes.length === printedNodes.length && nodes.every((node, i) => node === printedNodes[i]);
}

/** Ticks that `mse_px_0_9s` covers. */
const early = 179;

/** At the node where a lane is worst: the share of its whole-run squared error that came after 9 s. Null before that, or where nothing is known. */
export function lateShare(lane: LaneModel, nodes: readonly string[], metrics: readonly Metric[], ticks: number): { node: string; share: number } | null {
  if (ticks <= early) return null;
  const [whole, first] = (['mse_px', 'mse_px_0_9s'] as const).map((name) => table2([lane], nodes, metrics, name).rows[0]!.cells.map((cell) => cell.value));
  let worst = -1;
  nodes.forEach((_, i) => {
    if ((whole![i] ?? -1) > (whole![worst] ?? -1)) worst = i;
  });
  const [all, before] = [whole![worst], first![worst]];
  if (typeof all !== 'number' || typeof before !== 'number' || !(all > 0)) return null;
  return { node: nodes[worst]!, share: Math.min(1, Math.max(0, 1 - (before * early) / (all * ticks))) };
}

/** As rows of CSV, at full precision. */
export function table2Rows(table: Table2, name: MetricName, source: string): { columns: string[]; rows: (string | number)[][] } {
  const rows: (string | number)[][] = table.rows.map((row) => [row.lane, row.algorithm ?? '', name, ...row.cells.map((cell) => cell.value ?? '')]);
  if (printedApplies(table.nodes, name)) for (const one of printed) rows.push([one.lane, one.name, source, ...one.values]);
  return { columns: ['lane', 'algorithm', 'figure', ...table.nodes.map((node) => `node ${node}`)], rows };
}
