// Runs side by side: from the list and from a fork's page, with tolerances, alignment and files to take away.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage, refused } from './support/browser.mjs';
import { button } from './support/live.mjs';
import { counted, said } from './support/said.mjs';
import { call, finishedRun, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

describe('compare', () => {
  let server;
  let browser;
  let ids;
  let fork;

  withSite(async (site) => {
    ({ server, browser } = site);
    ids = [];
    for (const patch of [{}, { lanes: { consensus: { params: { tau: 0.02 } } } }]) {
      for (const seed of [1, 2]) ids.push((await finishedRun(server, { scenario: 'consensus', seed, patch })).id);
    }
    const made = await call(server, 'POST', `/runs/${ids[0]}/fork`, { k: 12, pace: 'max', patch: { adversary: { links: null } } });
    fork = await runUntil(server, made.id, 'finished');
  });

  const charts = (page) => page.getByRole('slider');
  const chip = (page, signal, text) => page.locator('section', { has: page.getByRole('heading', { name: signal, exact: true }) }).getByText(text);

  test('begins on the list of runs, with the keyboard', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/runs');
    for (const id of [ids[1], ids[0]]) {
      await page.getByRole('checkbox', { name: `Select run ${id}`, exact: true }).focus();
      await page.keyboard.press('Space');
    }
    await button(page, 'Compare').focus();
    await page.keyboard.press('Enter');
    await charts(page).first().waitFor();
    assert.equal(new URL(page.url()).searchParams.get('ids'), `${ids[0]},${ids[1]}`, 'the oldest is the base');
    await page.getByText('only the seeds may differ').waitFor();
    await view.close();
  });

  test('shows what the API says: verdicts, figures, pairs over seeds, parameters that differ', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const query = `ids=${ids.join(',')}&signals=lane.consensus.*.error&abs=0.5`;
    const answer = await call(server, 'GET', `/compare?${query}`);
    await view.goto(`/compare?${query}`);
    await counted(charts(page), 8);
    const row = page.getByRole('row', { name: /lanes\.consensus\.params\.tau/ });
    await said(row, /0\.02/);
    for (const verdict of answer.verdicts.filter((one) => one.signal === 'lane.consensus.1.error')) {
      const text = verdict.holds ? `${verdict.run}: within` : `${verdict.run}: ${(100 * verdict.inside).toPrecision(3)} % within, leaves at k ${verdict.first}`;
      await chip(page, verdict.signal, text).waitFor();
    }
    const pairs = answer.paired.find((one) => one.metric?.lane === 'consensus' && one.metric.name === 'rmse_position' && one.metric.node === null);
    assert.equal(pairs.n, 2);
    const metric = page.getByRole('row', { name: /^consensus rmse_position( |$)/ }).first();
    await said(metric, /n 2/);
    await page.getByRole('textbox', { name: 'Absolute tolerance' }).fill('1e6');
    await button(page, 'Compare').click();
    await chip(page, 'lane.consensus.1.error', `${ids[1]}: within`).waitFor();
    assert.equal(new URL(page.url()).searchParams.get('abs'), '1e6');
    await view.close();
  });

  test('a fork is compared with its origin, from its own page, and leaves it where it was made', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/runs/${fork.id}`);
    await page.getByRole('link', { name: 'Compare with its origin' }).click();
    await charts(page).first().waitFor();
    assert.equal(new URL(page.url()).searchParams.get('ids'), `${ids[0]},${fork.id}`);
    await page.getByRole('row', { name: /commands\.13\./ }).waitFor();
    await button(page, 'Link states').click();
    await page.getByText('leaves at k 13').first().waitFor();
    await charts(page).first().focus();
    await page.keyboard.press('End');
    await page.keyboard.press('ArrowLeft');
    await until('the cursor is in the address', async () => new URL(page.url()).searchParams.get('k') === '29');
    await page.reload();
    await charts(page).first().waitFor();
    await until('the address holds everything', async () => (await charts(page).first().getAttribute('aria-valuenow')) === '29');
    await view.close();
  });

  test('gives CSV and PNG', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/compare?ids=${ids[0]},${ids[2]}&signals=lane.consensus.1.error`);
    await charts(page).first().waitFor();
    const saved = async (name) => {
      const waiting = page.waitForEvent('download');
      await button(page, name).click();
      return readFileSync(await (await waiting).path());
    };
    const lines = (await saved('CSV of lane.consensus.1.error')).toString().trim().split('\n');
    assert.equal(lines[0], `k,run ${ids[0]},run ${ids[2]}`);
    assert.equal(lines.length, 32, 'a row a tick, from 0 to 30');
    const figures = (await saved('CSV of all figures')).toString();
    assert.match(figures, /^kind,name,run,against,/);
    assert.match(figures, /metric,consensus rmse_position/);
    assert.deepEqual([...(await saved('PNG of lane.consensus.1.error')).subarray(1, 4)], [...Buffer.from('PNG')]);
    await view.close();
  });

  test('says in one sentence what cannot be compared', async () => {
    const view = await openPage(browser, server, { allowed: [refused(400), refused(404)] });
    const { page } = view;
    await view.goto('/compare');
    await page.getByRole('heading', { name: 'Nothing to compare yet' }).waitFor();
    await view.goto(`/compare?ids=${ids[0]},999999`);
    await page.getByRole('alert').getByText('There is no run 999999.').waitFor();
    await view.goto(`/compare?ids=${ids[0]},${ids[1]}&signals=no.such.signal`);
    await page.getByRole('alert').getByText('No signal of these runs').waitFor();
    await view.close();
  });

  for (const [lang, theme, width] of [['en', 'light', 1440], ['zh', 'dark', 1024], ['en', 'dark', 390], ['zh', 'light', 390]]) {
    test(`has no barrier: ${lang}, ${theme}, ${width} px`, async () => {
      const view = await openPage(browser, server, { lang, theme, width });
      const { page } = view;
      await view.goto(`/compare?ids=${ids.join(',')}&signals=lane.consensus.*.error&abs=0.5&k=10`);
      await charts(page).first().waitFor();
      await checkAxe(page, `compare ${lang} ${theme} ${width}`);
      const wide = await page.locator('main').evaluate((main) => main.scrollWidth - main.clientWidth);
      assert.ok(wide <= 0, `nothing is wider than the page: ${wide} px`);
      await view.close();
    });
  }
});
