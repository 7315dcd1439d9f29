/// Reads the trials of a campaign, metric by metric and point by point, for parallel coordinates.
import { campaigns, type CampaignDetail, type TrialItem } from '../../api/campaigns';
import { ApiProblem } from '../../api/problem';
import { mostTrials, pathAxis, type TrialTable } from './parallel';

/** Calls at once: the server has other things to do. */
const kAtOnce = 3;

interface Column {
  index: number[];
  value: number[];
}

async function column(id: string, cell: number, metric: string, limit: number, signal: AbortSignal): Promise<TrialItem[]> {
  try {
    return (await campaigns.trials(id, { cell, metric, limit }, signal)).items;
  } catch (error) {
    // At this point no trial has the metric.
    if (error instanceof ApiProblem && error.errors[0]?.pointer === '/metric') return [];
    throw error;
  }
}

/** The first trials of the campaign, up to what is drawn. `tell` hears how many are there. Throws ApiProblem, and AbortError when ended. */
export async function readTrials(detail: CampaignDetail, metrics: readonly string[], tell: (rows: number) => void, signal: AbortSignal): Promise<TrialTable> {
  const paths = Object.entries(detail.sweep).map(([path, values]) => ({ path, ...pathAxis(path, values) }));
  const axes = [...paths.map(({ axis }) => axis), ...metrics.map((name) => ({ name, words: null }))];
  const wanted: { cell: number; limit: number; point: number[] }[] = [];
  let left = mostTrials;
  for (const { cell, done, sweep } of detail.cells) {
    const limit = Math.min(left, done);
    if (limit > 0) wanted.push({ cell, limit, point: paths.map(({ path, of }) => of(sweep[path])) });
    left -= limit;
  }
  const read: Column[][] = [];
  let next = 0;
  let rows = 0;
  const worker = async (): Promise<void> => {
    for (let i = next++; i < wanted.length; i = next++) {
      const { cell, limit } = wanted[i]!;
      const columns: Column[] = [];
      for (const metric of metrics) {
        const items = await column(detail.id, cell, metric, limit, signal);
        columns.push({ index: items.map((one) => one.index), value: items.map((one) => (typeof one.value === 'number' ? one.value : NaN)) });
      }
      read[i] = columns;
      tell((rows += limit));
    }
  };
  await Promise.all(Array.from({ length: kAtOnce }, worker));
  return joined(axes, wanted, read, detail.runs);
}

function joined(axes: TrialTable['axes'], wanted: { cell: number; limit: number; point: number[] }[], read: Column[][], runs: number): TrialTable {
  const rows = wanted.reduce((sum, one) => sum + one.limit, 0);
  const values = new Float64Array(rows * axes.length).fill(NaN);
  const cells = new Int32Array(rows);
  let first = 0;
  wanted.forEach(({ cell, limit, point }, i) => {
    for (let row = first; row < first + limit; row++) {
      cells[row] = cell;
      values.set(point, row * axes.length);
    }
    read[i]!.forEach(({ index, value }, m) => {
      index.forEach((trial, j) => {
        const row = trial - cell * runs;
        if (row < limit) values[(first + row) * axes.length + point.length + m] = value[j]!;
      });
    });
    first += limit;
  });
  return { axes, values, cells, rows };
}
