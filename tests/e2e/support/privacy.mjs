// What the tests know of the privacy family: its scenarios and their panels, and how the page writes its numbers and tables.
import assert from 'node:assert/strict';
import { openRange } from './live.mjs';
import { finishedRun, until } from './server.mjs';
import { everyTick, panel } from './sparse.mjs';

export const word = (lane) => lane.replaceAll('_', ' ');
/** As the page writes it: three significant digits. */
export const near = (text, value) => assert.ok(Math.abs(Number(text) - value) <= 0.006 * Math.abs(value) + 1e-12, `${text} for ${value}`);
const rowsOf = (place) => place.locator('tbody tr').evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
export const ranks = ['low', 'relatively low', 'medium', 'relatively high', 'high'];
const common = ['Tracks', 'Squared errors', 'Confidentiality', 'Messages', 'Attacks', 'Events'];
export const scenarios = {
  'privacy-robot-linear': common,
  'privacy-robot-nonlinear': common,
  'privacy-turn': [...common, 'Noise and error', 'Neighbouring releases', 'What is guaranteed'],
  'privacy-engine': [...common, 'Neighbouring releases', 'What is guaranteed'],
};

/** The panel's data as the page's own table: its columns and its rows, once every cell has its value. */
export async function tableOf(page, title, complete = (cells) => cells.every((cell) => cell !== '')) {
  const place = panel(page, title);
  const turn = place.getByRole('button', { name: `${title}: Data as a table` });
  await turn.click();
  const rows = await until(`the table of ${title} is filled`, async () => {
    const all = await rowsOf(place);
    return all.length > 0 && all.every(complete) && all;
  });
  const columns = await place.locator('thead th').allInnerTexts();
  await turn.click();
  return { columns, rows };
}

/** The fraction of the numbers that exceed a bound. */
export function shareAbove(values, bound) {
  const numbers = values.filter((value) => value !== null);
  return { n: numbers.length, share: numbers.filter((value) => value > bound).length / numbers.length };
}

/** A finished run of every scenario, and its page. */
export async function everyScenario({ server, browser }) {
  const runs = {};
  for (const scenario of Object.keys(scenarios)) runs[scenario] = await finishedRun(server, { scenario });
  return {
    runs,
    lanesOf: (scenario) => runs[scenario].world.lanes.map(({ id }) => id),
    /** Signals at the last tick, by name. */
    async lastOf(scenario, names) {
      const run = runs[scenario];
      const { of } = await everyTick(server, run.id, names, run.progress.k);
      return Object.fromEntries(names.map((name) => [name, of[name].at(-1)]));
    },
    async open(scenario, more = '', options = {}) {
      const run = runs[scenario];
      const view = await openRange(browser, server, run.id, run.progress.k, more, options);
      await view.page.locator('.tracks canvas').first().waitFor();
      return view;
    },
  };
}
