/// The results of a campaign by metric, lane and point.
import type { CampaignDetail, CampaignResults, CellSummary, MetricKey, MetricName, Point, Statistics } from '../../api/campaigns';

/** A metric whatever its lane: "name", "node.name", with ":variant". */
export function metricId({ node, name, variant }: Omit<MetricKey, 'lane'>): string {
  return `${node ? `${node}.` : ''}${name}${variant ? `:${variant}` : ''}`;
}

/** A lane's metric as the API of trials calls it. */
export const trialMetric = (lane: string, metric: string): string => `${lane}.${metric}`;

export interface Results {
  /** Over the whole network first, then node by node. */
  metrics: MetricName[];
  lanes: string[];
  /** Whether any point has it. */
  has: (metric: string, lane: number) => boolean;
  /** Undefined also where the metric's figures are not there yet. */
  of: (metric: string, lane: string, cell: number) => Statistics | undefined;
}

export type FigureTable = ReadonlyMap<string, Statistics>;

const figureKey = (metric: string, lane: string, cell: number): string => `${metric}|${lane}|${cell}`;

/** The figures of an answer beside those that are there; what it tells anew takes the place of the old. */
export function takeFigures(table: Map<string, Statistics>, answer: CampaignResults): void {
  const place = new Map(answer.figures.map((name, i) => [name, i + 3]));
  const figure = (row: (number | null)[], name: string): number | null => row[place.get(name) ?? -1] ?? null;
  for (const row of answer.rows) {
    const lane = answer.lanes[row[1]!]!;
    const metric = answer.metrics[row[2]!]!;
    const quantiles = Object.fromEntries(['0.05', '0.25', '0.75', '0.95'].map((p) => [p, figure(row, p)]));
    table.set(figureKey(metric, lane, row[0]!), { lane, mean: figure(row, 'mean'), se: figure(row, 'se'), median: figure(row, 'median'), min: figure(row, 'min'), max: figure(row, 'max'), quantiles, n: figure(row, 'n') ?? 0 });
  }
}

export function resultsOf({ lanes, metrics }: CampaignDetail['names'], table: FigureTable): Results {
  const known = new Map(metrics.map(({ id, lanes: own }) => [id, new Set(own)]));
  return {
    metrics: [...metrics.filter((one) => !one.node), ...metrics.filter((one) => one.node)],
    lanes,
    has: (metric, lane) => known.get(metric)?.has(lane) ?? false,
    of: (metric, lane, cell) => table.get(figureKey(metric, lane, cell)),
  };
}

/** How many trials of a cell are there. */
export function doneOf({ progress, runs }: Pick<CampaignDetail, 'progress' | 'runs'>, cell: number): number {
  return Math.max(0, Math.min(runs, progress.done - cell * runs));
}

/** What to show before anybody has chosen: an error if there is one. */
export function firstMetric(metrics: readonly MetricName[]): string {
  const whole = metrics.filter((one) => !one.node);
  return (whole.find(({ id }) => /^(rmse|rms|mse)/.test(id)) ?? whole[0] ?? metrics[0])?.id ?? '';
}

/** As it was given, for files. */
export const exactText = (value: unknown): string => (typeof value === 'string' ? value : JSON.stringify(value));

/** A swept value in few characters: 0.1 + 0.2 is 0.3 to the eye. */
export function valueText(value: unknown, most = 24): string {
  const text = typeof value === 'number' ? String(Number(value.toPrecision(9))) : exactText(value);
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
