// Watching and changing a run while it goes on.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { openPage } from './support/browser.mjs';
import { button, csvOf, cursorOf, openLive, rangeOf, shownTick, tickPast } from './support/live.mjs';
import { call, runUntil, startServer, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

describe('live page', () => {
  let server;
  let browser;
  withSite((site) => ({ server, browser } = site));

  /** Waits until the page has asked for the run and has taken the answer: the next question comes after that. */
  async function refreshed(page, run) {
    for (let i = 0; i < 2; i += 1) await page.waitForResponse((response) => response.url().endsWith(`/api/v1/runs/${run.id}`));
  }
  const tickOf = async (run) => (await call(server, 'GET', `/runs/${run.id}`)).progress.k;

  test('pauses, makes single steps and goes on', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await openLive(view, server, call);
    await button(page, 'Pause the run').click();
    await button(page, 'Resume the run').waitFor();
    await until('the server says paused', async () => (await call(server, 'GET', `/runs/${run.id}`)).state === 'paused');
    const k = await tickOf(run);
    await until('the page shows the tick it stands at', async () => (await shownTick(page)) === k);
    await button(page, 'Let the run make one step').click();
    await until('one step was made', async () => (await tickOf(run)) === k + 1);
    await until('the page shows it', async () => (await shownTick(page)) === k + 1);
    await button(page, 'Resume the run').click();
    await tickPast(page, k + 1);
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('zooms and scrubs while the run goes on, and comes back to live', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await openLive(view, server, call);
    await tickPast(page, 15);
    await page.locator('body').press('ArrowLeft');
    await until('a cursor stands in the past', () => cursorOf(page));
    const at = Number(cursorOf(page));
    await page.locator('body').press('Shift+ArrowLeft');
    await until('it stands ten ticks earlier', () => Number(cursorOf(page)) === Math.max(0, at - 10));
    const range = rangeOf(page);
    assert.ok(range, 'the window is held');
    await page.locator('body').press('+');
    await until('the window is narrower', () => rangeOf(page) !== range);
    const before = await tickOf(run);
    await until('the run goes on meanwhile', async () => (await tickOf(run)) > before + 5);
    assert.equal(await shownTick(page), Math.max(0, at - 10));
    await page.locator('body').press('l');
    await until('it follows again', () => rangeOf(page) === null && cursorOf(page) === null);
    await tickPast(page, before + 5);
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('changes a live parameter', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await openLive(view, server, call);
    await button(page, 'Parameters').click();
    const dialog = page.getByRole('dialog', { name: 'Parameters' });
    const pdos = dialog.locator('[id$="/adversary/links/params/pdos"]');
    await pdos.waitFor({ state: 'attached' });
    await pdos.evaluate((input) => {
      for (let fold = input.closest('details'); fold; fold = fold.parentElement?.closest('details')) fold.open = true;
    });
    await pdos.fill('0.5');
    await dialog.getByRole('button', { name: 'Apply' }).click();
    await until('the command is part of the run', async () => {
      const { commands } = await call(server, 'GET', `/runs/${run.id}`);
      return commands.some(({ body }) => body.params?.['adversary.links.params.pdos'] === 0.5);
    });
    await page.getByRole('log').getByText('command').first().waitFor();
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('attacks a link by hand, shows it in the events, and stops it', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await openLive(view, server, call, { patch: { time: { steps: null }, adversary: { links: null } } });
    const marks = async (edge) => (await call(server, 'GET', `/runs/${run.id}/marks?type=attack`)).items.filter((mark) => mark.edge === edge);
    await button(page, 'Attack a link').click();
    const dialog = page.getByRole('dialog', { name: 'Attack a link' });
    await dialog.getByRole('combobox', { name: 'Attack' }).selectOption('dos');
    await dialog.getByRole('checkbox', { name: 'all links' }).uncheck();
    await refreshed(page, run);
    await dialog.getByRole('button', { name: '2→3', exact: true }).click();
    await dialog.getByRole('button', { name: 'Start the attack' }).click();
    await until('the run has the attack', async () => (await marks('begin')).length > 0);
    await page.getByRole('log').getByText('attack', { exact: true }).first().waitFor();
    await button(page, 'Attack a link').click();
    await dialog.getByRole('button', { name: /^Stop / }).first().click();
    await until('the attack has ended', async () => (await marks('end')).length > 0);
    await dialog.getByText('None.').waitFor();
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('saves what a panel shows as CSV', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await openLive(view, server, call);
    await tickPast(page, 10);
    await button(page, 'Pause the run').click();
    await button(page, 'Resume the run').waitFor();
    const waiting = page.waitForEvent('download');
    await page.getByRole('button', { name: /^Position error: Save as CSV/ }).click();
    const [head, ...rows] = await csvOf(await waiting);
    assert.equal(head[0], 'k');
    assert.ok(head.includes('lane.consensus.rmse'), head.join());
    const column = head.indexOf('lane.consensus.rmse');
    assert.ok(rows.some((row) => Number(row[column]) > 0 && row[column].length > 8), 'full precision');
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('forks at the tick shown', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await openLive(view, server, call);
    await tickPast(page, 5);
    await button(page, 'Pause the run').click();
    await button(page, 'Resume the run').waitFor();
    const k = await tickOf(run);
    await until('the page shows the last tick', async () => (await shownTick(page)) === k);
    await page.getByRole('button', { name: 'Fork here' }).click();
    await page.waitForURL((url) => /\/live\/\d+/.test(url.pathname) && !url.pathname.endsWith(`/${run.id}`));
    const fork = await call(server, 'GET', `/runs/${/\/live\/(\d+)/.exec(page.url())[1]}`);
    assert.deepEqual(fork.parent, { run: run.id, k });
    await page.getByText(`forked from run ${run.id} at k = ${k}`).waitFor();
    await view.close();
    await call(server, 'DELETE', `/runs/${fork.id}`);
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('a note and a tag are text, not markup', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const nasty = '<img src=x onerror="document.title=1">';
    const run = await openLive(view, server, call, { tags: [nasty], note: nasty });
    await page.getByText(nasty).first().waitFor();
    assert.equal(await page.locator('main img, header img').count(), 0);
    assert.notEqual(await page.title(), '1');
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('a run that waits for its turn comes alive on the open page', async () => {
    const small = await startServer({ options: ['--no-demo', '--max-runs', '1'] });
    try {
      const view = await openPage(browser, small);
      const { page } = view;
      const endless = { scenario: 'consensus', pace: 20, patch: { time: { steps: null } } };
      const first = await call(small, 'POST', '/runs', endless);
      await runUntil(small, first.id, 'running');
      const second = await call(small, 'POST', '/runs', endless);
      await view.goto(`/live/${second.id}`);
      await page.getByText('queued', { exact: true }).first().waitFor();
      await call(small, 'PATCH', `/runs/${first.id}`, { state: 'stopped' });
      await tickPast(page, 5);
      await page.getByText('This run has no plane').waitFor({ state: 'detached' });
      await view.close();
    } finally {
      await small.stop();
    }
  });

  test('a page opened before the run has told its signals waits for them', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await call(server, 'POST', '/runs', { scenario: 'consensus', pace: 20, patch: { time: { steps: null } } });
    let early = 2;
    await page.route('**/signals', async (route) => {
      early -= 1;
      if (early >= 0) await route.fulfill({ json: { items: [], next: null } });
      else await route.fallback();
    });
    await view.goto(`/live/${run.id}`);
    await tickPast(page, 5);
    await page.getByRole('button', { name: /^Position error: Save as CSV/ }).waitFor();
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });
});
