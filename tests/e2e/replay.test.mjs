// The replay family's panels: detector, what-if, state and its set, errors, rates, runs in the log, the card; an attack by hand.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { button, openRange, query, tickPast } from './support/live.mjs';
import { counted } from './support/said.mjs';
import { call, finishedRun, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { everyTick, panel } from './support/sparse.mjs';

const last = 300;
const metricOf = (run, lane, name) => run.metrics.find((metric) => metric.lane === lane && metric.name === name && !metric.node && !metric.variant)?.value ?? null;
const word = (lane) => lane.replaceAll('_', ' ');
const card = (page) => page.locator('#profile');
const chooseLane = (page, lane) => panel(page, 'Detector').getByRole('combobox', { name: 'Lane' }).selectOption(lane);

/** TPR, FPR, accuracy, longest, delay of a row of the what-if, as text. */
async function whatIfRow(page, name) {
  return panel(page, 'What if').getByRole('row', { name }).locator('td').allInnerTexts();
}
function expectedRow(run, lane) {
  const share = (name) => metricOf(run, lane, name).toFixed(3);
  const delay = metricOf(run, lane, 'delay');
  return [share('tpr'), share('fpr'), share('accuracy'), String(metricOf(run, lane, 'longest')), delay === null ? '–' : String(delay)];
}
const shows = (page, name, wanted) => until(`${name} shows ${wanted.join(' ')}`, async () => ((await whatIfRow(page, name)).join() === wanted.join() ? true : null));

describe('the replay family', () => {
  let server;
  let browser;
  let run;
  withSite(async (site) => {
    ({ server, browser } = site);
    run = await finishedRun(server, { scenario: 'replay-ubb', seed: 3 });
  });

  async function open(more = '', options = {}) {
    const view = await openRange(browser, server, run.id, last, more, options);
    await view.page.locator('.detector canvas').first().waitFor();
    return view;
  }

  test('the detector has the statistic, the threshold and every lane’s alarm, as the log has them', async () => {
    const view = await open();
    const { page } = view;
    const detector = panel(page, 'Detector');
    const lanes = run.world.lanes.map(({ id }) => id).filter((id) => id !== 'ufir');
    const names = ['lane.repaired.1.statistic', 'lane.repaired.1.threshold', 'sensor.1.state', ...lanes.map((lane) => `lane.${lane}.1.alarm`)];
    const { of } = await everyTick(server, run.id, names, last);
    await detector.getByRole('button', { name: 'Detector: Data as a table' }).click();
    const rows = await until('the table is filled', async () => {
      const all = await detector.locator('tbody tr').evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
      return all.length === 100 && all.every((cells) => cells.slice(0, 4).every((cell, i) => i === 3 || cell !== '')) && all;
    });
    for (const [k, statistic, threshold, attacked, ...alarms] of rows) {
      const near = (text, name) => assert.ok(Math.abs(Number(text) - of[name][k]) <= 1e-3 * of[name][k], `k ${k}, ${name}: ${text} for ${of[name][k]}`);
      near(statistic, names[0]);
      near(threshold, names[1]);
      assert.equal(attacked.startsWith('R'), of['sensor.1.state'][k] === 3, `k ${k}`);
      lanes.forEach((lane, i) => assert.equal(alarms[i], String(of[`lane.${lane}.1.alarm`][k]), `k ${k}, ${lane}`));
    }
    await detector.getByRole('button', { name: 'Detector: Data as a table' }).click();
    await detector.getByRole('button', { name: 'linear', exact: true }).click();
    await until('the address has the scale', () => query(page, 'statistic') === 'linear');
    await view.close();
  });

  test('the what-if gives the rates of the very lane that has such a threshold, and changes nothing in the run', async () => {
    const view = await open('&lane=zeta1');
    const { page } = view;
    const whatIf = panel(page, 'What if');
    await whatIf.getByText('computed in this page; the run does not change').waitFor();
    await shows(page, /^zeta1 itself/, expectedRow(run, 'zeta1'));
    await shows(page, /^what if/, expectedRow(run, 'zeta1'));
    await whatIf.getByRole('button', { name: 'frozen', exact: true }).click();
    await shows(page, /^what if/, expectedRow(run, 'zeta1_freeze'));
    await shows(page, /^zeta1 itself/, expectedRow(run, 'zeta1'));
    await until('the address has it', () => query(page, 'whatif') === 'rule:frozen');
    // Two lanes with the same statistic and other windows.
    await chooseLane(page, 'zeta1_wm_freeze');
    await whatIf.getByRole('spinbutton', { name: 'window τ' }).fill('40');
    await whatIf.getByRole('spinbutton', { name: 'multiplier η' }).fill('3');
    await shows(page, /^what if/, expectedRow(run, 'repaired'));
    await panel(page, 'Detector').locator('.keys').getByText('what if').waitFor();
    await whatIf.getByRole('button', { name: 'fixed level', exact: true }).click();
    await whatIf.getByRole('spinbutton', { name: 'level', exact: true }).fill('1000');
    await shows(page, /^what if/, ['0.000', '0.000', (220 / 300).toFixed(3), '0', '–']);
    await whatIf.getByRole('button', { name: 'As the lane' }).click();
    await shows(page, /^what if/, expectedRow(run, 'zeta1_wm_freeze'));
    await until('the address is clean', () => query(page, 'whatif') === null);
    const now = await call(server, 'GET', `/runs/${run.id}`);
    assert.deepEqual([now.commands, now.document, now.metrics], [[], run.document, run.metrics]);
    await view.close();
  });

  test('as_written is blind and says so in the banner, at the detector and on the card; no other lane is called the paper’s', async () => {
    assert.ok(run.warnings.some((warning) => warning.startsWith('lane as_written: residual identically zero')));
    const view = await open('&lane=as_written');
    const { page } = view;
    await page.getByRole('status').getByText('as written: the residual is identically zero and the detector blind').waitFor();
    await panel(page, 'Detector').getByText('as written: the residual is zero whatever is replayed.').waitFor();
    await panel(page, 'Detector').getByRole('button', { name: 'Why' }).click();
    await until('the card has the focus', () => page.evaluate(() => document.activeElement?.id === 'profile'));
    await card(page).getByText('The detector is blind. The optimal gain is K = C⁻¹').waitFor();
    await card(page).getByText('This run confirms it').waitFor();
    for (const { id } of run.world.lanes) {
      await chooseLane(page, id);
      await until(`the address has ${id}`, () => query(page, 'lane') === id);
      await until(`the card is ${id}’s`, async () => {
        const heading = await card(page).locator('.heading').innerText();
        const blind = await card(page).getByText('The detector is blind').count();
        return heading.startsWith('The paper’s method') === (id === 'as_written' || id === 'eq29') && blind === (id === 'as_written' ? 1 : 0);
      });
    }
    await view.close();
    const chinese = await open('&lane=as_written', { lang: 'zh' });
    await chinese.page.getByRole('status').getByText('as written：残差恒为零，检测器是盲的').waitFor();
    await card(chinese.page).getByText('检测器是盲的。最优增益为 K = C⁻¹').waitFor();
    await chinese.close();
  });

  test('rates are the run’s metrics, sorted on demand, with what saying nothing would reach', async () => {
    const view = await open();
    const { page } = view;
    const rates = panel(page, 'Rates');
    const lanes = run.world.lanes.map(({ id }) => id);
    const rowsNow = () => rates.locator('tbody tr').evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
    const rows = await until('every lane has its rates', async () => ((all) => all.map(([lane]) => lane).join() === lanes.map(word).join() && all)(await rowsNow()));
    lanes.forEach((lane, i) => {
      const tpr = metricOf(run, lane, 'tpr');
      assert.equal(rows[i][1], tpr === null ? '–' : tpr.toFixed(3), lane);
      const without = metricOf(run, lane, 'event_without_attack');
      assert.equal(rows[i][5], without === null ? '–' : without ? 'yes' : 'no', lane);
      assert.ok(Math.abs(Number(rows[i][8]) - metricOf(run, lane, 'rmse_state')) < 0.006, lane);
    });
    await until('the baseline', async () => (await rates.getByRole('row', { name: /^always/ }).innerText()).includes((220 / 300).toFixed(3)));
    await rates.getByRole('button', { name: /^accuracy/ }).click();
    const best = lanes.filter((lane) => metricOf(run, lane, 'accuracy') !== null).toSorted((a, b) => metricOf(run, b, 'accuracy') - metricOf(run, a, 'accuracy'));
    await until('the best is first and the one without a detector last', async () => {
      const now = await rowsNow();
      return now[0][0] === word(best[0]) && now.at(-1)[0] === 'ufir';
    });
    await rates.getByRole('button', { name: 'Copy as CSV' }).click();
    const lines = await until('the clipboard has them', async () => {
      const text = await page.evaluate(() => navigator.clipboard.readText());
      return text.startsWith('lane,tpr') && text.trim().split('\n');
    });
    assert.equal(lines.length, 1 + lanes.length + 1);
    assert.equal(Number(lines[1].split(',')[3]), metricOf(run, best[0], 'accuracy'));
    await view.close();
  });

  test('the density counts every tick outside the attack from 20 on', async () => {
    const view = await open('&beside=zonotope');
    const { page } = view;
    const names = ['repaired', 'zonotope'].flatMap((lane) => [`lane.${lane}.1.estimate.x1`, `lane.${lane}.truth.x1`]);
    const { of } = await everyTick(server, run.id, [...names, 'sensor.1.state'], last);
    const picture = panel(page, 'Errors and their density').getByRole('img', { name: /^Density of the error of x1/ });
    const expect = async (counts) => {
      const label = await until('the density is made', async () => {
        const text = await picture.getAttribute('aria-label');
        return /zonotope mean/.test(text) && new RegExp(`${of[names[0]].filter((_, k) => counts(k)).length} ticks`).test(text) && text;
      });
      for (const lane of ['repaired', 'zonotope']) {
        const errors = of[`lane.${lane}.1.estimate.x1`].map((value, k) => value - of[`lane.${lane}.truth.x1`][k]).filter((_, k) => counts(k));
        const mean = errors.reduce((sum, error) => sum + error, 0) / errors.length;
        const deviation = Math.sqrt(errors.reduce((sum, error) => sum + (error - mean) ** 2, 0) / (errors.length - 1));
        const [, m, d] = new RegExp(`${lane} mean (\\S+), standard deviation (\\S+),`).exec(label);
        assert.ok(Math.abs(Number(m) - mean) <= 0.006 * Math.abs(mean) && Math.abs(Number(d) - deviation) <= 0.006 * deviation, label);
      }
    };
    await expect((k) => k >= 20 && !(of['sensor.1.state'][k] > 0));
    await panel(page, 'Errors and their density').getByRole('button', { name: 'all', exact: true }).click();
    await expect((k) => k >= 20);
    await panel(page, 'State and its set').getByRole('img', { name: /ellipsoid M/ }).waitFor();
    await counted(panel(page, 'State and its set').getByRole('application'), 2);
    await view.close();
  });

  test('runs of the same scenario are averaged, others and changed ones left out; more are made on demand', async () => {
    const more = [];
    for (const seed of [4, 5]) more.push(await call(server, 'POST', '/runs', { scenario: 'replay-ubb', seed, pace: 'max' }));
    await call(server, 'POST', '/runs', { scenario: 'replay-ubb', seed: 6, pace: 'max', patch: { adversary: { replay: { params: { case: 2 } } } } });
    const changed = await call(server, 'POST', '/runs', { scenario: 'replay-ubb', seed: 9, pace: 60 });
    await call(server, 'POST', `/runs/${changed.id}/attacks`, { type: 'replay', on: ['sensor:1'], params: { record_from: 1, record_to: 2, start: 290 } });
    await call(server, 'PATCH', `/runs/${changed.id}`, { pace: 'max' });
    assert.equal((await runUntil(server, changed.id, 'finished')).changes, 1);
    const all = [run, ...(await Promise.all(more.map(({ id }) => runUntil(server, id, 'finished'))))];
    const view = await open();
    const { page } = view;
    const trials = panel(page, 'Runs in this log');
    await trials.scrollIntoViewIfNeeded();
    await trials.getByText('3 runs, one a seed').waitFor();
    const mean = all.reduce((sum, one) => sum + metricOf(one, 'eq29', 'accuracy'), 0) / 3;
    await until('the mean', async () => (await trials.getByRole('row', { name: /^eq29 \d/ }).locator('td').first().innerText()).startsWith(mean.toFixed(3)));
    await trials.getByRole('button', { name: 'Run 20 more seeds' }).click();
    await trials.getByText('23 runs, one a seed').waitFor();
    await view.close();
  });

  test('an attack begun by hand on a running experiment is shown, scored and stopped', async () => {
    const live = await call(server, 'POST', '/runs', { scenario: 'replay-ubb', seed: 8, pace: 20, patch: { time: { steps: null }, adversary: { replay: null } } });
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/live/${live.id}`);
    await tickPast(page, 60);
    const now = () => call(server, 'GET', `/runs/${live.id}`);
    const marks = async (edge) => (await call(server, 'GET', `/runs/${live.id}/marks?type=attack`)).items.filter((mark) => mark.edge === edge);
    assert.equal(metricOf(await now(), 'repaired', 'tpr'), null);
    await button(page, 'Attack a sensor').click();
    const dialog = page.getByRole('dialog', { name: 'Attack a sensor' });
    await until('the replay is what is offered', async () => (await dialog.getByRole('combobox', { name: 'Attack' }).inputValue()) === 'replay');
    await dialog.getByRole('button', { name: 'Start the attack' }).click();
    const [begun] = await until('the run has the attack', async () => {
      const all = await marks('begin');
      return all.length && all;
    });
    await page.getByRole('log').getByText('attack', { exact: true }).first().waitFor();
    await tickPast(page, begun.k + 8);
    await until('the page scores it', async () => Number((await whatIfRow(page, /^repaired itself/))[0]) > 0 && Number(await panel(page, 'Rates').getByRole('row', { name: /^repaired \d/ }).locator('td').first().innerText()) > 0);
    await until('the card speaks of attacked ticks', async () => /flagged .+ of the attacked ticks/.test(await card(page).innerText()));
    await button(page, 'Attack a sensor').click();
    await dialog.getByRole('button', { name: /^Stop / }).first().click();
    await until('the attack has ended', async () => (await marks('end')).length > 0);
    await dialog.getByText('None.').waitFor();
    await page.keyboard.press('Escape');
    const after = await now();
    assert.ok(metricOf(after, 'repaired', 'tpr') > 0);
    assert.equal(metricOf(after, 'as_written', 'tpr'), 0);
    assert.equal(after.commands.length, 2);
    await view.close();
    await call(server, 'DELETE', `/runs/${live.id}`);
  });

  for (const [theme, lang, width] of [['light', 'en', 1440], ['dark', 'zh', 1024], ['light', 'zh', 390]]) {
    test(`nothing for axe to say: ${theme}, ${lang}, ${width} px`, async () => {
      const view = await open('&lane=as_written&k=130&whatif=rule:frozen', { theme, lang, width });
      await view.page.locator('.rates td').first().waitFor();
      await view.page.locator('.whatif td').first().waitFor();
      await checkAxe(view.page, `the replay panels, ${theme} ${lang} ${width}`);
      await view.close();
    });
  }
});
