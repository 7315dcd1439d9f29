/// The results of a campaign by metric, lane and point.
import type { CampaignDetail, CellSummary, MetricKey, Point, Statistics } from '../../api/campaigns';

/** A metric whatever its lane: "name", "node.name", with ":variant". */
export function metricId({ node, name, variant }: Omit<MetricKey, 'lane'>): string {
  return `${node ? `${node}.` : ''}${name}${variant ? `:${variant}` : ''}`;
}

/** A lane's metric as the API of trials calls it. */
export const trialMetric = (lane: string, metric: string): string => `${lane}.${metric}`;

export interface Results {
  /** Over the whole network first, then node by node. */
  metrics: { id: string; node: boolean }[];
  lanes: string[];
  of: (metric: string, lane: string, cell: number) => Statistics | undefined;
}

const resultKey = (metric: string, lane: string, cell: number): string => `${metric}|${lane}|${cell}`;

export function resultsOf(all: CampaignDetail['metrics']): Results {
  const metrics = new Map<string, boolean>();
  const lanes = new Set<string>();
  const table = new Map<string, Statistics>();
  for (const one of all) {
    const id = metricId(one);
    metrics.set(id, one.node !== null);
    lanes.add(one.lane);
    table.set(resultKey(id, one.lane, one.cell), one);
  }
  const list = [...metrics].map(([id, node]) => ({ id, node }));
  return { metrics: [...list.filter((one) => !one.node), ...list.filter((one) => one.node)], lanes: [...lanes], of: (metric, lane, cell) => table.get(resultKey(metric, lane, cell)) };
}

/** What to show before anybody has chosen: an error if there is one. */
export function firstMetric(results: Results): string {
  const whole = results.metrics.filter((one) => !one.node);
  return (whole.find(({ id }) => /^(rmse|rms|mse)/.test(id)) ?? whole[0] ?? results.metrics[0])?.id ?? '';
}

/** A swept value in few characters. */
export function valueText(value: unknown, most = 24): string {
  const text = typeof value === 'string' ? value : JSON.stringify(value);
  return text.length > most ? `${text.slice(0, most - 1)}…` : text;
}

/** The last names of a path; as many as it takes to tell it from the others. */
export function shortPath(path: string, all: readonly string[]): string {
  const steps = path.split('.');
  for (let n = 1; n < steps.length; n++) {
    const text = steps.slice(-n).join('.');
    if (all.every((other) => other === path || !`.${other}`.endsWith(`.${text}`))) return text;
  }
  return path;
}

export function pointText(point: Point, all: readonly string[] = Object.keys(point)): string {
  return Object.entries(point)
    .map(([path, value]) => `${shortPath(path, all)} ${valueText(value)}`)
    .join(', ');
}

/** Where the values of a swept path stand: numbers where all are, else one after the other. */
export interface SweptAxis {
  path: string;
  values: unknown[];
  numeric: boolean;
  /** Ascending where numeric. */
  at: number[];
}

export function sweptAxis(path: string, values: readonly unknown[]): SweptAxis {
  const numeric = values.every((value) => typeof value === 'number') && new Set(values).size === values.length;
  const sorted = numeric ? [...(values as number[])].sort((a, b) => a - b) : [...values];
  return { path, values: sorted, numeric, at: sorted.map((value, i) => (numeric ? (value as number) : i)) };
}

const indices = new WeakMap<readonly CellSummary[], Map<string, CellSummary>>();

function pointKey(point: Point): string {
  return JSON.stringify(Object.keys(point).sort().map((path) => [path, point[path]]));
}

/** The cell of a point that names every swept path. A grid has up to 10 000 cells: they are indexed once. */
export function cellAt(cells: readonly CellSummary[], point: Point): CellSummary | undefined {
  let index = indices.get(cells);
  if (!index) {
    index = new Map(cells.map((cell) => [pointKey(cell.sweep), cell]));
    indices.set(cells, index);
  }
  return index.get(pointKey(point));
}

/** What a slice holds fast, in words; empty where nothing is. */
export function fixedText(base: Point, free: readonly string[]): string {
  const rest = Object.fromEntries(Object.entries(base).filter(([path]) => !free.includes(path)));
  return pointText(rest, Object.keys(base));
}
