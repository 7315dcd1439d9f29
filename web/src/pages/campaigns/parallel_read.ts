/// Reads the values of all trials for parallel coordinates.
import { campaigns, type CampaignDetail } from '../../api/campaigns';
import { mostTrials, pathAxis, type TrialTable } from './parallel';

/** The first trials of the campaign, up to what is drawn. Throws ApiProblem, and AbortError when ended. */
export async function readTrials(detail: CampaignDetail, metrics: readonly string[], signal: AbortSignal): Promise<TrialTable> {
  const paths = Object.entries(detail.sweep).map(([path, values]) => ({ path, ...pathAxis(path, values) }));
  const axes = [...paths.map(({ axis }) => axis), ...metrics.map((name) => ({ name, words: null }))];
  const { n: rows, values: read } = await campaigns.values(detail.id, { metrics, from: 0, limit: mostTrials }, signal);
  const values = new Float64Array(rows * axes.length).fill(NaN);
  const cells = new Int32Array(rows);
  const points = detail.cells.map(({ sweep }) => paths.map(({ path, of }) => of(sweep[path])));
  for (let row = 0; row < rows; row++) {
    const cell = Math.floor(row / detail.runs);
    cells[row] = cell;
    values.set(points[cell] ?? [], row * axes.length);
    for (let m = 0; m < metrics.length; m++) values[row * axes.length + paths.length + m] = read[m]?.[row] ?? NaN;
  }
  return { axes, values, cells, rows, runs: detail.runs, firstSeed: detail.first_seed };
}
