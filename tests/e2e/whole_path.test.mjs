// The lab from end to end: compose, run, attack by hand, see who notices and when, fork without, compare, take the bundle and run it again.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { openPage } from './support/browser.mjs';
import { button, tickPast } from './support/live.mjs';
import { binary, call, folder, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

const last = 200;
const attackAt = 120;

/** The columns of a frame file that belong to lanes, as texts. */
function lanesOf(csv) {
  const [head, ...rows] = csv.trim().split(/\r?\n/).map((line) => line.split(','));
  const own = head.map((name, i) => [name, i]).filter(([name]) => name.startsWith('lane.')).toSorted();
  return { names: own.map(([name]) => name), rows: rows.map((row) => own.map(([, i]) => (row[i] === '' ? '' : Number(row[i])))) };
}

describe('the whole path', () => {
  let server;
  let browser;
  withSite((site) => ({ server, browser } = site));
  const idOf = (page) => /\/live\/(\d+)/.exec(page.url())[1];

  test('from a composed scenario to a bundle that runs again identically', async () => {
    const view = await openPage(browser, server, { acceptDownloads: true });
    const { page } = view;

    // Compose: the scenario's own attack goes, one from the table comes, a second detector stands beside the first.
    await view.goto('/scenarios/replay-mixed');
    await button(page, 'Remove replay').click();
    await page.getByRole('heading', { name: 'Attacks and lanes' }).click();
    await button(page, 'Add noise on actuator:1 to the scenario').click();
    await page.locator('[id="f/time/steps"]').fill(String(last));
    await page.getByRole('textbox', { name: 'Seed' }).fill('11');
    await page.getByRole('textbox', { name: 'ticks per second' }).fill('2');
    await button(page, 'Run').click();
    await page.waitForURL(/\/live\/\d+/);
    const origin = idOf(page);
    await tickPast(page, 2);
    await button(page, 'Pause the run').click();
    await button(page, 'Resume the run').waitFor();
    const { k } = (await call(server, 'GET', `/runs/${origin}`)).progress;
    await call(server, 'PATCH', `/runs/${origin}`, { step: attackAt - k });
    await tickPast(page, attackAt - 1);

    // Attack by hand, on the drawing; see who notices.
    const taken = page.getByRole('listbox', { name: /^Links, sensors/ });
    await taken.focus();
    const ids = await taken.locator('[role=option]').evaluateAll((options) => options.map((option) => option.dataset.target));
    await taken.press('Home');
    for (let i = 0; i < ids.indexOf('node:1'); i += 1) await taken.press('ArrowRight');
    await taken.press('Enter');
    await page.getByRole('menuitem', { name: 'Replay', exact: true }).click();
    const [command] = await until('the attack is a command of the run', async () => {
      const { commands } = await call(server, 'GET', `/runs/${origin}`);
      return commands.length ? commands : null;
    });
    assert.equal(command.k, attackAt + 1);
    await call(server, 'PATCH', `/runs/${origin}`, { pace: 'max' });
    await button(page, 'Resume the run').click();
    const finished = await runUntil(server, origin, 'finished');
    const { items } = await call(server, 'GET', `/runs/${origin}/marks?type=alarm&limit=5000`);
    const noticed = items.find((mark) => mark.lane === 'repaired' && mark.edge === 'begin' && mark.k >= command.k);
    assert.ok(noticed, 'the repaired detector notices the replay');
    const attack = command.body.attack.id;
    const ticks = noticed.k - command.k;
    const words = ticks === 0 ? 'noticed at once' : ticks === 1 ? 'noticed after 1 tick' : `noticed after ${ticks} ticks`;
    const told = page.locator(`.attacks [data-attack="${attack}"] [data-lane="repaired"]`);
    await until(words, async () => (await told.count()) > 0 && (await told.first().textContent()).trim().endsWith(words));

    // Fork just before it: the branch does not have it.
    await view.goto(`/live/${origin}?k=${attackAt}&range=0-${last}`);
    await page.getByRole('button', { name: 'Fork here' }).click();
    await page.waitForURL((url) => /\/live\/\d+/.test(url.pathname) && !url.pathname.endsWith(`/${origin}`));
    const fork = idOf(page);
    const branch = await runUntil(server, fork, 'finished');
    assert.deepEqual(branch.parent, { run: origin, k: attackAt });
    assert.deepEqual(branch.commands, []);

    // Compare them.
    await view.goto(`/runs/${fork}`);
    await page.getByRole('link', { name: 'Compare with its origin' }).click();
    await page.getByRole('row', { name: new RegExp(`commands\\.${attackAt + 1}\\.`) }).first().waitFor();
    const answer = await call(server, 'GET', `/compare?ids=${origin},${fork}&signals=lane.repaired.1.estimate.*`);
    assert.ok(answer.verdicts.some(({ first }) => first > attackAt), 'they part after the fork, not before');
    assert.ok(answer.verdicts.every(({ holds, first }) => holds || first > attackAt));

    // Take the bundle and run it again, on the command line and through the API.
    await view.goto('/runs');
    await page.getByRole('checkbox', { name: `Select run ${origin}`, exact: true }).check();
    const [download] = await Promise.all([page.waitForEvent('download'), button(page, 'Bundle').click()]);
    const place = folder();
    try {
      const bundle = join(place.path, 'bundle.json');
      await download.saveAs(bundle);
      const frames = join(place.path, 'frames.csv');
      execFileSync(binary, ['run', bundle, '--frames', frames, '--json', join(place.path, 'again.json')], { stdio: 'pipe' });
      const response = await fetch(`${server.url}/api/v1/runs/${origin}/samples?signals=lane.*`, { headers: { Accept: 'text/csv' } });
      assert.equal(response.status, 200);
      const [first, again] = [await response.text(), readFileSync(frames, 'utf8')].map(lanesOf);
      assert.ok(first.names.length > 100);
      assert.deepEqual(again.names, first.names);
      assert.deepEqual(again.rows, first.rows, 'every value of every lane at every tick');
      const { metrics } = JSON.parse(readFileSync(join(place.path, 'again.json'), 'utf8'));
      assert.deepEqual(metrics, finished.metrics);
    } finally {
      place.remove();
    }
    await view.close();
  });
});
