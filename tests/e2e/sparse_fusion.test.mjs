// Whose estimate every node takes and why, what it makes of the attack on its sensor, and whether that can be known at all.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { tickPast } from './support/live.mjs';
import { counted, said } from './support/said.mjs';
import { call, finishedRun, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { channels, everyTick, letters, panel, stations } from './support/sparse.mjs';

const last = 200;

describe('the game and the reconstruction', () => {
  let server;
  let browser;
  let run;
  withSite(async (site) => {
    ({ server, browser } = site);
    run = await finishedRun(server, { scenario: 'sparse', seed: 5 });
  });

  const start = (more) => call(server, 'POST', '/runs', { scenario: 'sparse', ...more });
  const inTable = (page, title) => panel(page, title).getByRole('button', { name: `${title}: Data as a table` });
  const ticks = (names) => everyTick(server, run.id, names, last);

  test('the raster tells every choice, and which of them were attacked nodes', async () => {
    const { of } = await ticks(stations.flatMap((id) => [`sensor.${id}.state`, `lane.omp_game.${id}.choice`]));
    const stateAt = (id, k) => of[`sensor.${id}.state`][k];
    const chosen = (id, k) => stations[of[`lane.omp_game.${id}.choice`][k]];
    const known = stations.flatMap((id) => Array.from({ length: last + 1 }, (_, k) => [id, k])).filter(([id, k]) => chosen(id, k) !== undefined && stateAt(id, k) !== null);
    const attacked = known.filter(([id, k]) => stateAt(chosen(id, k), k) > 0);
    assert.ok(known.length > 5 * 190 && attacked.length > 0, 'the last second has choices of attacked nodes');

    const view = await openPage(browser, server);
    await view.goto(`/live/${run.id}?range=0-${last}`);
    await panel(view.page, 'Chosen estimate').getByText(`attacked node taken ${attacked.length} times in ${known.length.toLocaleString('en')}`).waitFor();
    await inTable(view.page, 'Chosen estimate').click();
    const rows = panel(view.page, 'Chosen estimate').locator('tbody tr');
    const shown = await until('the table is filled', async () => {
      const all = await rows.evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
      return all.length > 90 && all;
    });
    for (const [k, ...cells] of shown.slice(0, 40)) {
      const wanted = stations.map((id) => `${chosen(id, k)}${stateAt(chosen(id, k), k) ? ` (${letters[stateAt(chosen(id, k), k)]})` : ''}`);
      assert.deepEqual(cells, wanted, `tick ${k}`);
    }
    await view.close();
  });

  test('the game of a node at the cursor: no game before the window is full, then its utilities and probabilities', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const at = panel(page, 'Utility and probability');
    await view.goto(`/live/${run.id}?range=0-${last}&k=3&node=3`);
    await at.getByText('At k = 3 there is no game: the window of readings is not full.').waitFor();

    const candidates = ['1', '3', '4', '5'];
    const { of } = await ticks(['lane.omp_game.3.choice', ...candidates.flatMap((id) => [`lane.omp_game.3.probability.${id}`, `lane.omp_game.3.utility.${id}`, `sensor.${id}.state`])]);
    await view.goto(`/live/${run.id}?range=0-${last}&k=150&node=3`);
    await at.getByRole('row').nth(candidates.length).waitFor();
    const rows = await at.locator('tbody tr').evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
    assert.equal(rows.length, candidates.length);
    for (const [i, id] of candidates.entries()) {
      assert.match(rows[i][0], new RegExp(`^${id}\\b`));
      assert.equal(rows[i][2], of[`lane.omp_game.3.probability.${id}`][150].toFixed(3));
      assert.ok(Math.abs(Number(rows[i][4]) - of[`lane.omp_game.3.utility.${id}`][150]) <= 0.005 * Math.abs(of[`lane.omp_game.3.utility.${id}`][150]) + 1e-9, rows[i][4]);
      assert.equal(rows[i][0].includes('sensor attacked'), of[`sensor.${id}.state`][150] > 0, id);
      assert.equal(rows[i][0].includes('taken'), stations[of['lane.omp_game.3.choice'][150]] === id, id);
    }
    await at.getByRole('combobox', { name: 'Node' }).selectOption('2');
    await until('another node is in the address', () => new URL(page.url()).searchParams.get('node') === '2');
    await at.getByRole('row').nth(3).waitFor();
    await view.close();
  });

  test('hits, misses and false entries are counted per channel, and the metrics are told as they are', async () => {
    const names = channels.flatMap((channel) => [`sensor.2.${channel}.injected`, `lane.omp_game.2.attack.${channel}`]);
    const { of } = await ticks(names);
    const view = await openPage(browser, server);
    const { page } = view;
    const box = panel(page, 'Reconstructed attack');
    await view.goto(`/live/${run.id}?range=0-${last}&node=2`);
    for (const channel of channels) {
      const count = { hits: 0, misses: 0, falses: 0 };
      of[`lane.omp_game.2.attack.${channel}`].forEach((found, k) => {
        const truth = of[`sensor.2.${channel}.injected`][k];
        if (found === null || truth === null) return;
        if (truth !== 0) count[found !== 0 ? 'hits' : 'misses']++;
        else if (found !== 0) count.falses++;
      });
      await box.getByText(`${channel}: ${count.hits} hits, ${count.misses} misses, ${count.falses} false entries`).waitFor({ state: 'attached' });
    }
    const metric = (name, variant) => run.metrics.find((one) => one.lane === 'omp_game' && one.name === name && one.variant === variant).value;
    for (const type of ['I', 'II']) {
      const found = await said(box.getByText(`Type ${type}: exact support found in `), /in ([\d.]+) % of the windows; ([\d.]+) % of the entries found, ([\d.]+) false/);
      const text = found[0];
      const [exact, hit, falses] = found.slice(1).map(Number);
      assert.ok(Math.abs(exact - 100 * metric('omp_exact', type)) <= 0.5, text);
      assert.ok(Math.abs(hit - 100 * metric('omp_hit_rate', type)) <= 0.5, text);
      assert.ok(Math.abs(falses - metric('omp_false_entries', type)) <= 0.01 * falses, text);
    }
    await box.getByRole('button', { name: /^Why/ }).click();
    await until('the verdict has the focus', () => page.evaluate(() => document.activeElement?.id === 'identifiability'));
    await view.close();
  });

  test('the verdict follows the report of the run, and changes with it', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const verdict = panel(page, 'Can the attack be identified?');
    const report = run.design.omp_game.identifiability;
    await view.goto(`/live/${run.id}`);
    await verdict.getByText(`2qT = ${report.dimension[0]} is not more than pT − n = ${report.dimension[1]}`).waitFor();
    await verdict.getByText(`in more than 2q = ${2 * report.q} channels of a station, and the least is ${report.eigvec_support}`).waitFor();
    await verdict.getByText(`holds for q ≤ ${report.q_max}; this lane is set to q = ${report.q}`).waitFor();
    await verdict.getByText('comes from the game, not from the reconstruction').waitFor();
    await verdict.getByText('Station by station').click();
    await counted(verdict.getByRole('row'), 1 + stations.length);
    const chinese = await openPage(browser, server, { lang: 'zh' });
    await chinese.goto(`/live/${run.id}`);
    await chinese.page.getByText(`2qT = ${report.dimension[0]} 不超过 pT − n = ${report.dimension[1]}`).waitFor();
    await chinese.close();

    const narrow = await start({ pace: 'max', patch: { time: { steps: 8 }, lanes: { omp_game: { params: { q: 1 } } } } });
    await runUntil(server, narrow.id, 'finished');
    await view.goto(`/live/${narrow.id}?lane=omp_game`);
    await verdict.getByText('The eigenvector test holds').waitFor();
    await verdict.getByText('nothing promises that matching pursuit finds it').waitFor();
    assert.equal(await verdict.getByText('The eigenvector test fails').count(), 0);
    await view.close();
  });

  test('the schedule says who is attacked at the cursor; in another family only where a sensor is', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const schedule = panel(page, 'Sensors under attack');
    await view.goto(`/live/${run.id}?range=0-${last}&k=150`);
    await schedule.getByText('at k = 150: 3 II, 5 I').waitFor();
    await view.goto(`/live/${run.id}?range=0-${last}&k=190`);
    await schedule.getByText('at k = 190: 1 I, 3 II, 5 I').waitFor();

    const bias = { type: 'bias', on: ['sensor:3'], from: 2, to: 6, params: { vector: [5, 5] } };
    const shorter = { scenario: 'consensus', pace: 'max', seed: 1 };
    const biased = await call(server, 'POST', '/runs', { ...shorter, patch: { time: { steps: 12 }, adversary: { bias } } });
    const plain = await call(server, 'POST', '/runs', { ...shorter, patch: { time: { steps: 12 } } });
    for (const { id } of [biased, plain]) await runUntil(server, id, 'finished');
    await view.goto(`/live/${biased.id}?k=4`);
    await schedule.getByText('at k = 4: 3 F').waitFor();
    await view.goto(`/live/${plain.id}?k=4`);
    await panel(page, 'Links under attack').waitFor();
    assert.equal(await schedule.count(), 0);
    await view.close();
  });

  test('goes on with the run: a live game, and what was injected beside what was found', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const live = await start({ seed: 5, pace: 20, patch: { time: { steps: null } } });
    await view.goto(`/live/${live.id}`);
    await tickPast(page, 20);
    const shown = async () => Number(/at k = (\d+)/.exec(await panel(page, 'Utility and probability').innerText())?.[1] ?? -1);
    const first = await until('a game is shown', async () => ((await panel(page, 'Utility and probability').locator('tbody tr').count()) ? shown() : 0));
    await until('a later one', async () => (await shown()) > first + 10);
    const counted = () => panel(page, 'Reconstructed attack').locator('.counts').first().innerText();
    const before = await until('entries are counted', counted);
    await until('more are', async () => (await counted()) !== before);
    await view.close();
    await call(server, 'DELETE', `/runs/${live.id}`);
  });

  for (const [theme, lang, width] of [['light', 'en', 1440], ['dark', 'zh', 1024], ['light', 'zh', 390]]) {
    test(`nothing for axe to say: ${theme}, ${lang}, ${width} px`, async () => {
      const view = await openPage(browser, server, { theme, lang, width });
      await view.goto(`/live/${run.id}?range=0-${last}&k=150`);
      await view.page.locator('#identifiability').waitFor();
      await view.page.locator('.panel.strategy tbody tr').first().waitFor();
      await checkAxe(view.page, `the sparse panels, ${theme} ${lang} ${width}`);
      const [inner, outer] = await view.page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(inner <= outer, 'nothing wider than the screen');
      await view.close();
    });
  }
});
