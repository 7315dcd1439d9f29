// The privacy family's panels: tracks, squared errors, the index and its ranks, messages; listening by hand; keyboard, themes, widths.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { button, csvOf, query, tickPast } from './support/live.mjs';
import { everyScenario, near, ranks, scenarios, tableOf, word } from './support/privacy.mjs';
import { counted, number, said } from './support/said.mjs';
import { call, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { everyTick, panel } from './support/sparse.mjs';

describe('the privacy family', () => {
  let server;
  let browser;
  let [runs, open, lanesOf, lastOf] = [];
  withSite(async (site) => {
    ({ server, browser } = site);
    ({ runs, open, lanesOf, lastOf } = await everyScenario(site));
  });

  for (const [scenario, titles] of Object.entries(scenarios)) {
    test(`${scenario} has its panels, and every lane’s index in the strip`, async () => {
      const view = await open(scenario);
      for (const title of titles) await panel(view.page, title).waitFor();
      await counted(view.page.locator('.grid > .cell'), titles.length);
      const lanes = lanesOf(scenario);
      const measured = await lastOf(scenario, lanes.flatMap((lane) => [`lane.${lane}.ci`, `lane.${lane}.ci_mse`, `lane.${lane}.rank`]));
      for (const lane of lanes) {
        const figure = view.page.locator('.figure.lane', { hasText: word(lane) });
        const text = await until(`the index of ${lane} is there`, async () => ((said) => !said.includes('–') && said)(await figure.innerText()));
        near(/-?\d\S*(?=\s+CI)/.exec(text)[0], measured[`lane.${lane}.ci`] ?? measured[`lane.${lane}.ci_mse`]);
        assert.ok(text.trim().endsWith(ranks[measured[`lane.${lane}.rank`]]), text);
      }
      await view.close();
    });
  }

  test('a track over time is the true component, the user’s and the eavesdropper’s, as the log has them', async () => {
    const scenario = 'privacy-robot-linear';
    const view = await open(scenario, '&lane=contamination');
    const { rows } = await tableOf(view.page, 'Tracks');
    const names = ['lane.contamination.eve.fusing.estimate.position', 'lane.contamination.fused.estimate.position', 'truth.position'];
    const { of } = await everyTick(server, runs[scenario].id, names, 100);
    assert.equal(rows.length, 100);
    for (const [k, ...cells] of rows) names.forEach((name, i) => near(cells[i], of[name][k]));
    // Section 2.5: about half the position. Its shape leaks, and the page says so.
    const share = of[names[0]].at(-1) / of[names[2]].at(-1);
    assert.ok(share > 0.4 && share < 0.6, `${share}`);
    await panel(view.page, 'Tracks').getByText('its shape leaks').waitFor();
    await view.close();
  });

  test('where the state has a plane the paths are drawn in it, and each component over time', async () => {
    const view = await open('privacy-robot-nonlinear', '&lane=contamination&k=60');
    const { page } = view;
    const tracks = panel(page, 'Tracks');
    await tracks.getByRole('img', { name: /^Paths in the plane up to tick 60, contamination: eavesdropper, fusing, user, true$/ }).waitFor();
    await tracks.getByRole('button', { name: 'over time' }).click();
    await tracks.getByRole('combobox', { name: 'Component' }).selectOption('theta');
    await tracks.getByRole('application', { name: /^theta over time/ }).waitFor();
    assert.equal(query(page, 'tracks'), 'theta');
    await tracks.getByRole('button', { name: 'plane' }).click();
    await until('the address is plain again', () => query(page, 'tracks') === null);
    await view.close();
  });

  test('squared errors have the traces beside them; curves and eavesdroppers are chosen; the CSV has what is drawn', async () => {
    const scenario = 'privacy-engine';
    const view = await open(scenario, '&lane=two_step');
    const { page } = view;
    const squares = panel(page, 'Squared errors');
    const head = (name) => `lane.two_step.${name}`;
    const { columns, rows } = await tableOf(page, 'Squared errors', (cells) => cells.filter((cell) => cell === '').length === 0);
    assert.deepEqual(columns.slice(-2), ['user, covariance', 'user']);
    const { of } = await everyTick(server, runs[scenario].id, [head('fused.trace'), head('fused.square')], 200);
    for (const [k, ...cells] of rows) {
      near(cells.at(-2), of[head('fused.trace')][k]);
      near(cells.at(-1), of[head('fused.square')][k]);
    }
    await squares.getByRole('button', { name: 'covariances' }).click();
    await squares.getByRole('button', { name: 'eavesdropper, window mean' }).click();
    await squares.getByRole('button', { name: 'sent', exact: true }).click();
    await until('the address has the curves', () => query(page, 'curves') === 'other.window_mean,sent' && query(page, 'traces') === 'off');
    assert.equal(await panel(page, 'Tracks').getByRole('button', { name: 'eavesdropper, window mean' }).getAttribute('aria-pressed'), 'false', 'on every panel');
    const [download] = await Promise.all([page.waitForEvent('download'), squares.getByRole('button', { name: /as CSV/ }).click()]);
    const [names, ...lines] = await csvOf(download);
    assert.deepEqual(names.slice(2).toSorted(), ['1.sent_square', '2.sent_square', 'eve.differencing.square', 'fused.square', 'optimal.square'].map(head).toSorted());
    assert.equal(lines.length, 201);
    await view.close();
  });

  test('users and eavesdroppers of all lanes are compared in one picture', async () => {
    const view = await open('privacy-engine', '&lane=two_step');
    const { page } = view;
    const squares = panel(page, 'Squared errors');
    await squares.getByRole('button', { name: 'users', exact: true }).click();
    const lanes = lanesOf('privacy-engine').map(word);
    for (const lane of lanes) await squares.getByRole('application', { name: new RegExp(`legitimate user.*${lane}`) }).waitFor();
    await squares.getByRole('button', { name: 'eavesdroppers', exact: true }).click();
    await squares.getByRole('application', { name: /two step, differencing.*two step, window mean.*contamination, fusing/ }).waitFor();
    await squares.getByRole('button', { name: 'contamination', exact: true }).click();
    await until('a hidden lane is not drawn', async () => !(await squares.getByRole('application').getAttribute('aria-label')).includes('contamination'));
    assert.equal(query(page, 'squares'), 'eves');
    await view.close();
  });

  test('the gauge says every lane’s index, its rank, other eavesdroppers and the paper’s number: infinite is no number', async () => {
    const scenario = 'privacy-engine';
    const view = await open(scenario);
    const place = panel(view.page, 'Confidentiality');
    const names = [...lanesOf(scenario).map((lane) => `lane.${lane}.ci`), 'lane.two_step.eve.window_mean.ci'];
    const of = await lastOf(scenario, names);
    const label = await until('the gauge has every lane', async () => {
      const text = await place.getByRole('img').getAttribute('aria-label');
      return !text.includes('nothing yet') && /window mean \d/.test(text) && text;
    });
    for (const lane of lanesOf(scenario)) {
      const [, ci, rank] = new RegExp(`[:;] ${word(lane)} (\\S+), ([a-z ]+), CI of covariances`).exec(label);
      near(ci, of[`lane.${lane}.ci`]);
      assert.equal(rank, ranks[[1, 2, 4, 8].filter((bound) => of[`lane.${lane}.ci`] >= bound).length]);
    }
    near(/two step.*window mean (-?[\d.]+)/.exec(label)[1], of['lane.two_step.eve.window_mean.ci']);
    assert.match(label, /two step [^;]*the paper prints infinite/);
    assert.match(label, /contamination [^;]*the paper prints 1\.23/);
    assert.match(label, /secrecy code a [^;]*the paper prints 3\.66/);
    await view.close();
  });

  test('beside the index stand the analytic slope, the paper’s claim and whom it leaves out', async () => {
    const scenario = 'privacy-engine';
    const { design } = runs[scenario];
    const view = await open(scenario);
    const place = panel(view.page, 'Confidentiality');
    const grows = place.getByText('the variance of the differencing eavesdropper grows by');
    near((await said(grows, new RegExp(`grows by ${number} per step`)))[1], design.two_step.slope);
    near((await said(grows, new RegExp(`leaks ${number}\\)`)))[1], design.two_step.leak);
    const ci = (await lastOf(scenario, ['lane.two_step.ci', 'lane.two_step.eve.window_mean.ci']));
    near((await said(grows, new RegExp(`every step: ${number} now`)))[1], ci['lane.two_step.ci']);
    near((await said(place.getByText('Theorem 4.2'), new RegExp(`an index of ${number}, rank low`)))[1], ci['lane.two_step.eve.window_mean.ci']);
    assert.ok(ci['lane.two_step.eve.window_mean.ci'] < 1);
    // At another tick it is another index.
    await panel(view.page, 'Squared errors').getByRole('application').focus();
    await view.page.keyboard.press('0');
    for (let i = 0; i < 3; i++) await view.page.keyboard.press('Shift+ArrowLeft');
    const { of } = await everyTick(server, runs[scenario].id, ['lane.two_step.ci'], 200);
    const k = Number(await until('the cursor is set', () => query(view.page, 'k')));
    await until('the index is the cursor’s', async () => Math.abs(Number((await said(grows, new RegExp(`every step: ${number} now`)))[1]) - of['lane.two_step.ci'][k]) < 0.006 * of['lane.two_step.ci'][k]);
    await view.close();
  });

  test('contaminated components are a raster, as the log has them; the network shows them at the cursor', async () => {
    const scenario = 'privacy-robot-linear';
    const view = await open(scenario, '&lane=contamination&k=10');
    const { page } = view;
    const { rows } = await tableOf(page, 'Messages', (cells) => cells.length === 9 && cells.at(-4) === 'E');
    const names = ['1', '2'].flatMap((node) => ['position', 'velocity'].map((component) => `lane.contamination.${node}.contaminated.${component}`));
    const { of } = await everyTick(server, runs[scenario].id, names, 100);
    for (const [k, ...cells] of rows) names.forEach((name, i) => assert.equal(cells[i], of[name][k] ? 'C' : '', `${name} at ${k}`));
    const own = (node) => names.filter((name) => name.startsWith(`lane.contamination.${node}.`) && of[name][10]).map((name) => name.split('.').at(-1)).join(', ');
    const label = await until('the picture has the cursor’s tick', async () => ((text) => text.includes('contaminates') && text)(await panel(page, 'Messages').getByRole('img').getAttribute('aria-label')));
    assert.match(label, /tick 10: link from 1 to fused is overheard/);
    for (const node of ['1', '2']) assert.ok(label.includes(`${node} contaminates ${own(node)}`), label);
    await view.close();
  });

  test('listening starts by hand, with the keyboard, on a chosen link; the page shows who is overheard from then on', async () => {
    const { id } = await call(server, 'POST', '/runs', { scenario: 'privacy-robot-linear', pace: 20, patch: { time: { steps: null }, adversary: { eve: null } } });
    await runUntil(server, id, 'running');
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/live/${id}`);
    await tickPast(page, 2);
    const picture = panel(page, 'Messages').getByRole('img');
    const tracks = await page.locator('section.tracks').elementHandle();
    await until('nobody listens', async () => (await picture.getAttribute('aria-label')).includes('link from 1 to fused is not overheard'));
    await button(page, 'Attack a link').focus();
    await page.keyboard.press('Enter');
    const dialog = page.getByRole('dialog', { name: 'Attack a link' });
    await dialog.getByRole('combobox', { name: 'Attack' }).selectOption('eavesdrop');
    await dialog.getByRole('checkbox', { name: 'all links' }).focus();
    await page.keyboard.press('Space');
    await dialog.getByRole('button', { name: '2→fused' }).focus();
    await page.keyboard.press('Enter');
    await dialog.getByRole('button', { name: 'Start the attack' }).focus();
    await page.keyboard.press('Enter');
    await until('one link is overheard', async () => ((text) => text.includes('link from 2 to fused is overheard') && text.includes('link from 1 to fused is not overheard'))(await picture.getAttribute('aria-label')));
    await panel(page, 'Events').getByText(/eavesdrop/).first().waitFor();
    await tickPast(page, 100);
    assert.equal(await tracks.evaluate((place) => place.isConnected), true, 'panels stay as the run goes on');
    await view.close();
    await call(server, 'DELETE', `/runs/${id}`);
  });

  test('keys and charts of the panels are reached and used by keyboard', async () => {
    const view = await open('privacy-engine', '&lane=two_step');
    const { page } = view;
    const key = panel(page, 'Tracks').getByRole('button', { name: 'eavesdropper, zero estimate' });
    await key.focus();
    await page.keyboard.press('Enter');
    await until('the zero estimate is drawn', async () => (await key.getAttribute('aria-pressed')) === 'true' && query(page, 'curves') === 'other.zero');
    await panel(page, 'Tracks').getByRole('application', { name: /zero estimate/ }).waitFor();
    await page.keyboard.press('Space');
    await until('and no longer', async () => (await key.getAttribute('aria-pressed')) === 'false');
    const reached = await panel(page, 'What is guaranteed').getByRole('group', { name: /^What every observer learns/ });
    await reached.focus();
    assert.equal(await reached.evaluate((place) => place === document.activeElement), true);
    await view.close();
  });

  const looks = [['privacy-robot-linear', 'light', 'en', 1440], ['privacy-robot-nonlinear', 'dark', 'zh', 1024], ['privacy-turn', 'light', 'zh', 390], ['privacy-turn', 'dark', 'en', 1440], ['privacy-engine', 'dark', 'zh', 390], ['privacy-engine', 'light', 'en', 1024], ['privacy-engine', 'light', 'zh', 1440]];
  for (const [scenario, theme, lang, width] of looks) {
    test(`nothing for axe to say, nothing wider than the screen: ${scenario}, ${theme}, ${lang}, ${width} px`, async () => {
      const view = await open(scenario, '&k=40', { theme, lang, width });
      const { page } = view;
      await page.locator('.confidentiality canvas').first().waitFor();
      await page.locator('.messages canvas').first().waitFor();
      if (scenarios[scenario].includes('What is guaranteed')) await page.locator('.guarantee td').first().waitFor();
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
      await checkAxe(page, `the privacy panels of ${scenario}, ${theme} ${lang} ${width}`);
      await view.close();
    });
  }
});
