// Somebody's own table: readings and truth of a simulated run under names that are not ours, and estimates of a filter of theirs.
import { call } from './server.mjs';

/** Columns of a run as text, full precision, no line ends to trip over. */
export async function csvOfRun(server, run, signals) {
  const query = signals ? `?signals=${signals.join()}` : '';
  const answer = await fetch(`${server.url}/api/v1/runs/${run}/samples${query}`, { headers: { Accept: 'text/csv' } });
  if (!answer.ok) throw new Error(await answer.text());
  return answer.text();
}

export const rowsOf = (csv) => csv.trim().split('\n').map((line) => line.split(','));

/** What a person would call it; `mystery` is what no name tells. */
function foreignName(signal) {
  const [kind, a, b] = signal.split('.');
  if (signal === 'sensor.2.q') return 'mystery';
  return kind === 'sensor' ? `Node ${a}: ${b}` : kind === 'truth' ? `true ${a}` : signal;
}

/** How far their filter is from the truth, per component. */
export const off = { x: 0.3, y: -0.4, theta: 0 };

/**
 * The table: `names` by signal, `text`, and `lane`, which signal a column of their estimates is. Theirs are at node 1 alone.
 */
export async function foreignTable(server, run) {
  const { columns } = await call(server, 'GET', '/scenarios/consensus/columns');
  const [, ...rows] = rowsOf(await csvOfRun(server, run, columns));
  const names = columns.map(foreignName);
  const truth = Object.fromEntries(Object.keys(off).map((component) => [component, columns.indexOf(`truth.${component}`)]));
  const theirs = Object.keys(off).map((component) => `${component}hat_1`);
  const lines = rows.map(([k, t, ...cells]) => {
    const estimates = Object.keys(off).map((component) => Number(cells[truth[component]]) + off[component]);
    return [`row ${k}`, t, ...cells, ...estimates].join();
  });
  return {
    text: `${['what', 'Time', ...names, ...theirs].join()}\n${lines.join('\n')}\n`,
    names: Object.fromEntries([...columns.map((signal, i) => [signal, names[i]]), ...Object.keys(off).map((component, i) => [`lane.mine.1.estimate.${component}`, theirs[i]])]),
  };
}
