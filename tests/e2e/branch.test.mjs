// A fork without the attack beside its origin: the other branch's curves over ours, from where they part.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { query, tickPast } from './support/live.mjs';
import { near } from './support/privacy.mjs';
import { number, said } from './support/said.mjs';
import { call, finishedRun, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { everyTick, panel } from './support/sparse.mjs';

const last = 60;
const parts = 20;
const bias = { type: 'bias', on: ['sensor:3'], from: 30, to: 50, params: { vector: [40, 40] } };

describe('branches of a run', () => {
  let server;
  let browser;
  let origin;
  let fork;
  withSite(async (site) => {
    ({ server, browser } = site);
    origin = await finishedRun(server, { scenario: 'consensus', seed: 7, patch: { time: { steps: last }, adversary: { bias } } });
    const { id } = await call(server, 'POST', `/runs/${origin.id}/fork`, { k: parts, patch: { adversary: { bias: null } } });
    fork = await runUntil(server, id, 'finished');
  });

  const chart = (page, other) => panel(page, 'Position error').getByRole('application', { name: new RegExp(`with run ${other}$`) });
  const drawn = (page) => panel(page, 'Position error').locator('.plot').screenshot();

  test('the fork shows its origin: both at the cursor as the log has them, the same before they part', async () => {
    const signal = 'lane.consensus.rmse';
    const [theirs, mine] = await Promise.all([origin, fork].map(async ({ id }) => (await everyTick(server, id, [signal], last)).of[signal]));
    assert.deepEqual(theirs.slice(0, parts + 1), mine.slice(0, parts + 1));
    assert.ok(theirs[40] > mine[40], 'the attack is seen');
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/live/${fork.id}?k=40`);
    await page.getByText(`Forked from run ${origin.id} at k = ${parts}.`).waitFor();
    await panel(page, 'Position error').locator('canvas').last().waitFor();
    const before = await until('the chart stands still', async () => {
      const one = await drawn(page);
      return one.equals(await drawn(page)) && one;
    });
    await page.getByRole('button', { name: 'Show its origin' }).click();
    await chart(page, origin.id).waitFor();
    await until('its curves are drawn', async () => !(await drawn(page)).equals(before));
    assert.equal(query(page, 'with'), origin.id);
    await page.getByText(`run ${origin.id}, thin and dotted, from k = ${parts}`).waitFor();
    near((await said(chart(page, origin.id), new RegExp(`consensus ${number} cm`)))[1], mine[40]);
    near((await said(chart(page, origin.id), new RegExp(`consensus, run ${origin.id} ${number} cm`)))[1], theirs[40]);
    await page.reload();
    near((await said(chart(page, origin.id), new RegExp(`consensus, run ${origin.id} ${number} cm`)))[1], theirs[40]);
    await view.goto(`/live/${fork.id}?k=10&with=${origin.id}`);
    await said(chart(page, origin.id), new RegExp(`k = 10\\s+consensus ${number} cm`));
    assert.equal((await chart(page, origin.id).innerText()).includes(`run ${origin.id}`), false, 'before the fork there is one curve');
    await page.getByRole('button', { name: 'Show its origin' }).click();
    await until('it is gone', async () => query(page, 'with') === null && (await chart(page, origin.id).count()) === 0);
    await view.close();
  });

  test('the origin lists its forks, overlays one, and leads to the comparison', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/live/${origin.id}`);
    await page.getByRole('button', { name: `Overlay run ${fork.id}, from k = ${parts}` }).focus();
    await page.keyboard.press('Enter');
    await chart(page, fork.id).waitFor();
    await page.getByRole('link', { name: 'Compare the two' }).click();
    await page.waitForURL(/\/compare\?/);
    assert.equal(new URL(page.url()).searchParams.get('ids'), `${origin.id},${fork.id}`);
    await view.close();
  });

  test('a run that is no branch is not drawn, and the page says so', async () => {
    const other = await finishedRun(server, { scenario: 'consensus', seed: 8 });
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/live/${fork.id}?with=${other.id}`);
    await page.getByText(`Run ${other.id} is no branch of this one`).waitFor();
    await page.getByRole('button', { name: 'Hide it' }).click();
    await until('the address forgets it', () => query(page, 'with') === null);
    await view.close();
  });

  test('two branches that both go on: the other’s curve grows with it', async () => {
    const live = await call(server, 'POST', '/runs', { scenario: 'consensus', seed: 3, pace: 20, patch: { time: { steps: null } } });
    await until('it runs', async () => (await call(server, 'GET', `/runs/${live.id}`)).progress.k > 5);
    const twin = await call(server, 'POST', `/runs/${live.id}/fork`, { k: 5 });
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/live/${twin.id}?with=${live.id}`);
    await chart(page, live.id).waitFor();
    const k = await tickPast(page, 30);
    await page.getByRole('button', { name: 'Hold the view' }).or(page.getByRole('button', { name: 'Live', exact: true })).first().waitFor();
    await panel(page, 'Position error').getByRole('application').focus();
    await page.keyboard.press('Shift+ArrowLeft');
    const cursor = Number(await until('the cursor is set', () => query(page, 'k')));
    assert.ok(cursor > 5 && cursor >= k - 11, String(cursor));
    const { of } = await everyTick(server, live.id, ['lane.consensus.rmse'], cursor);
    near((await said(chart(page, live.id), new RegExp(`consensus, run ${live.id} ${number} cm`)))[1], of['lane.consensus.rmse'][cursor]);
    await view.close();
    for (const { id } of [live, twin]) await call(server, 'DELETE', `/runs/${id}`);
  });

  test('a detector’s statistic has the other branch as well', async () => {
    const run = await finishedRun(server, { scenario: 'replay-nongaussian', seed: 2 });
    const { id } = await call(server, 'POST', `/runs/${run.id}/fork`, { k: 50 });
    const twin = await runUntil(server, id, 'finished');
    const view = await openPage(browser, server);
    await view.goto(`/live/${twin.id}?with=${run.id}`);
    await panel(view.page, 'Detector').getByRole('application', { name: new RegExp(`with run ${run.id}$`) }).waitFor();
    await view.close();
  });

  for (const [theme, lang, width] of [['light', 'en', 1440], ['dark', 'zh', 1024], ['dark', 'zh', 390]]) {
    test(`nothing for axe to say, nothing wider than the screen: ${theme}, ${lang}, ${width} px`, async () => {
      const view = await openPage(browser, server, { theme, lang, width });
      await view.goto(`/live/${fork.id}?with=${origin.id}&k=40`);
      await view.page.locator('.beside').first().waitFor();
      assert.equal(await view.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
      await checkAxe(view.page, `the branches, ${theme} ${lang} ${width}`);
      await view.close();
    });
  }
});
