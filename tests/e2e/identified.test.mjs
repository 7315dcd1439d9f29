// Data of one's own: a recorded table becomes a model, a trace and a scored run, and the page shows what the command line says.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openRange } from './support/live.mjs';
import { finishedRun, folder, root, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { panel } from './support/sparse.mjs';

const vigil = process.env.VIGIL_BINARY ?? join(root, 'build', 'release', 'vigil');
const last = 499;

/** Two tanks under two pumps, hour by hour; where `attacked`, hours 300 to 319 read tank 1 a metre too high. */
function recording(rows, attacked) {
  let seed = 7;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  const noise = () => 0.05 * (random() + random() + random() + random() - 2);
  let [one, two] = [3, 2];
  let text = 'WHEN, L_T1, L_T2, S_PU1, S_PU2, FLAG\n';
  for (let k = 0; k < rows; ++k) {
    const pumps = [random() < 0.4 ? 1 : 0, random() < 0.6 ? 1 : 0];
    const wrong = attacked && k >= 300 && k < 320;
    text += `hour ${k},${one + (wrong ? 1 : 0)},${two},${pumps.join()},${wrong ? 1 : -999}\n`;
    [one, two] = [0.9 * one + 0.5 * pumps[0] + noise(), 0.1 * one + 0.8 * two + 0.3 * pumps[1] + noise()];
  }
  return text;
}

describe('an identified plant', () => {
  let server;
  let browser;
  let run;
  const own = folder();
  withSite(async (site) => {
    ({ server, browser } = site);
    const at = (name) => join(own.path, name);
    writeFileSync(at('clean.csv'), recording(1500, false));
    writeFileSync(at('later.csv'), recording(last + 1, true));
    const columns = ['--outputs', 'L_T*', '--inputs', 'S_*', '--label', 'FLAG', '--dt', '3600'];
    execFileSync(vigil, ['identify', at('clean.csv'), ...columns, '--out', at('tanks.json'), '--trace-of', at('later.csv'), '--trace-out', at('trace.csv')]);
    const sent = await fetch(`${server.url}/api/v1/traces?name=later`, { method: 'POST', headers: { 'Content-Type': 'text/csv' }, body: readFileSync(at('trace.csv')) });
    assert.ok(sent.ok, await sent.clone().text());
    const { id } = await sent.json();
    run = await finishedRun(server, { scenario: JSON.parse(readFileSync(at('tanks.json'), 'utf8')), input: { trace: id } });
    own.remove();
  });

  test('the page has the flags of every detector beside the labelled hours, with the rates of the run', async () => {
    const view = await openRange(browser, server, run.id, last, '', { height: 1400 });
    const { page } = view;
    await page.locator('.detector canvas').first().waitFor();
    const metric = (lane, name) => run.metrics.find((one) => one.lane === lane && one.name === name && !one.node)?.value;
    for (const lane of ['all_chi_square', 'all_cusum', 'all_fixed', 'all_dynamic']) {
      const wanted = ['tpr', 'fpr', 'accuracy'].map((name) => metric(lane, name).toFixed(3));
      const row = panel(page, 'Rates').getByRole('row', { name: lane.replaceAll('_', ' ') });
      await until(`${lane} shows ${wanted}`, async () => ((await row.locator('td').allInnerTexts()).slice(0, 3).join() === wanted.join() ? true : null));
    }
    assert.equal(metric('all_fixed', 'delay'), 0, 'a metre is more than thirty standard deviations: seen in its first hour');
    const detector = panel(page, 'Detector');
    assert.equal(await detector.getByRole('combobox', { name: 'Lane' }).inputValue(), 'all_fixed', 'the lane that the scenario leads with');
    // Whoever judges all sensors at once is told of the attack as well: the fixed threshold's flags in it are hits.
    await panel(page, 'What if').getByRole('row', { name: 'all fixed itself' }).waitFor();
    const itself = await panel(page, 'What if').getByRole('row', { name: 'all fixed itself' }).locator('td').allInnerTexts();
    assert.equal(itself[0], metric('all_fixed', 'tpr').toFixed(3));
    await checkAxe(page, 'a run of an identified plant');
    await view.close();
  });
});
