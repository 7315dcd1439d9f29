// Finding runs again, and what can be done with them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, test } from 'node:test';
import { holdClock, openPage, refused } from './support/browser.mjs';
import { button } from './support/live.mjs';
import { said } from './support/said.mjs';
import { call, finishedRun, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

describe('runs', () => {
  let server;
  let browser;
  let ids;
  const nasty = '<img src=x onerror="document.title=1">';

  withSite(async (site) => {
    ({ server, browser } = site);
    ids = [];
    for (let seed = 1; seed <= 5; seed += 1) {
      const patch = seed === 3 ? { lanes: { consensus: { params: { tau: 0.02 } } } } : {};
      const tags = seed === 4 ? ['paper', nasty] : [];
      const run = await finishedRun(server, { scenario: 'consensus', seed, patch, tags });
      ids.push(run.id);
    }
  });

  const shown = (page) => page.locator('tr[data-run]').evaluateAll((rows) => rows.map((row) => row.dataset.run));
  const showing = (page, wanted) => until(`the list shows ${wanted}`, async () => (await shown(page)).join() === wanted.join());

  test('lists them newest first with state, seed, figures and only the changed parameters', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/runs');
    await showing(page, [...ids].reverse());
    const row = page.locator(`tr[data-run="${ids[2]}"]`);
    await row.getByText('consensus.tau=0.02').waitFor();
    await said(row, /finished/);
    await page.locator(`tr[data-run="${ids[0]}"]`).getByText('none').waitFor();
    const { metrics } = await call(server, 'GET', `/runs/${ids[2]}`);
    const rmse = metrics.find((one) => one.lane === 'consensus' && one.node === null && one.name === 'rmse_position').value;
    await until(`the row has ${rmse}`, async () => (await row.innerText()).includes(rmse.toPrecision(3)));
    await view.close();
  });

  test('asks with OR and ranges, keeps the question in the address, sorts', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/runs');
    await page.getByRole('searchbox', { name: 'Find runs' }).fill('seed:1..2 OR tags:paper');
    await button(page, 'Search').click();
    await showing(page, [ids[3], ids[1], ids[0]]);
    assert.equal(new URL(page.url()).searchParams.get('q'), 'seed:1..2 OR tags:paper');
    await page.reload();
    await showing(page, [ids[3], ids[1], ids[0]]);
    await button(page, 'Seed').click();
    await button(page, 'Seed').click();
    await showing(page, [ids[0], ids[1], ids[3]]);
    await page.getByRole('searchbox', { name: 'Find runs' }).fill('seed:1..5 AND NOT (seed:2..4)');
    await button(page, 'Search').click();
    await showing(page, [ids[0], ids[4]]);
    await page.getByRole('searchbox', { name: 'Find runs' }).fill('seed:99');
    await button(page, 'Search').click();
    await page.getByRole('heading', { name: 'No run matches' }).waitFor();
    await view.close();
  });

  test('shows where a query cannot be read', async () => {
    const view = await openPage(browser, server, { allowed: [refused(400), refused(422)] });
    const { page } = view;
    await view.goto('/runs');
    await page.getByRole('searchbox', { name: 'Find runs' }).fill('seed:1 AND (state:finished');
    await button(page, 'Search').click();
    const alert = page.locator('#run-query-problem');
    await alert.waitFor();
    await said(alert, /Column \d+/);
    await alert.locator('mark').waitFor();
    assert.equal(await page.getByRole('searchbox').getAttribute('aria-invalid'), 'true');
    await button(page, 'Clear').click();
    await showing(page, [...ids].reverse());
    await view.close();
  });

  test('tags, and shows a tag as text', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/runs');
    await page.getByText(nasty).first().waitFor();
    assert.equal(await page.locator('main img').count(), 0);
    await page.getByRole('checkbox', { name: `Select run ${ids[0]}`, exact: true }).check();
    await button(page, 'Tag').click();
    await page.getByRole('textbox', { name: 'Tag to add' }).fill('keep');
    await button(page, 'Add').click();
    await page.locator(`tr[data-run="${ids[0]}"] .tag`, { hasText: 'keep' }).waitFor();
    assert.deepEqual((await call(server, 'GET', `/runs/${ids[0]}`)).tags, ['keep']);
    await button(page, 'Remove tag keep').click();
    await until('the tag is gone', async () => (await call(server, 'GET', `/runs/${ids[0]}`)).tags.length === 0);
    assert.notEqual(await page.title(), '1');
    await view.close();
  });

  test('saves the list as CSV', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/runs?q=seed:1..2');
    await showing(page, [ids[1], ids[0]]);
    const waiting = page.waitForEvent('download');
    await button(page, 'CSV of the list').click();
    const lines = readFileSync(await (await waiting).path(), 'utf8').trim().split('\r\n');
    assert.equal(lines.length, 3);
    assert.match(lines[0], /^id,state,scenario,.*consensus\.rmse_position/);
    assert.match(lines[1], new RegExp(`^${ids[1]},finished,consensus,`));
    await view.close();
  });

  test('takes a bundle away and brings it back', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/runs');
    await page.getByRole('checkbox', { name: `Select run ${ids[1]}`, exact: true }).check();
    const waiting = page.waitForEvent('download');
    await button(page, 'Bundle').click();
    const path = await (await waiting).path();
    await page.locator('input[type=file]').setInputFiles({ name: 'bundle.json', mimeType: 'application/json', buffer: readFileSync(path) });
    const message = page.getByText(/Run \d+ was imported\./);
    const [id] = await said(message, /\d+/);
    const [imported, original] = await Promise.all([call(server, 'GET', `/runs/${id}`), call(server, 'GET', `/runs/${ids[1]}`)]);
    assert.equal(imported.seed, original.seed);
    assert.deepEqual(imported.document, original.document);
    await view.close();
    await call(server, 'DELETE', `/runs/${id}`);
  });

  test('runs again, and sees the new run without being asked', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/runs');
    await showing(page, [...ids].reverse());
    await page.getByRole('checkbox', { name: `Select run ${ids[0]}`, exact: true }).check();
    await button(page, 'Run again').click();
    const message = page.getByText(/Started: run \d+\./);
    const [id] = await said(message, /\d+/);
    await page.locator(`tr[data-run="${id}"]`, { hasText: 'finished' }).waitFor();
    const metric = async (run) => (await call(server, 'GET', `/runs/${run}`)).metrics.find((one) => one.name === 'rmse_position' && one.node === null).value;
    assert.equal(await metric(id), await metric(ids[0]), 'the same seed gives the same figure');
    const other = await call(server, 'POST', '/runs', { scenario: 'consensus', seed: 77, pace: 'max' });
    await page.locator(`tr[data-run="${other.id}"]`, { hasText: 'finished' }).waitFor();
    await view.close();
    await call(server, 'DELETE', `/runs/${id}`);
    await call(server, 'DELETE', `/runs/${other.id}`);
  });

  test('deletes with time to think again', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await holdClock(page);
    await view.goto('/runs');
    await page.getByRole('checkbox', { name: `Select run ${ids[4]}`, exact: true }).check();
    await button(page, 'Delete').click();
    await page.locator(`tr[data-run="${ids[4]}"]`).waitFor({ state: 'detached' });
    await page.clock.runFor(9_000);
    assert.equal((await call(server, 'GET', `/runs/${ids[4]}`)).id, ids[4], 'nothing was deleted');
    await button(page, 'Undo').click();
    await page.locator(`tr[data-run="${ids[4]}"]`).waitFor();
    await page.clock.runFor(20_000);
    assert.equal((await call(server, 'GET', `/runs/${ids[4]}`)).id, ids[4], 'it was taken back for good');
    await page.getByRole('checkbox', { name: `Select run ${ids[4]}`, exact: true }).check();
    await button(page, 'Delete').click();
    await page.locator(`tr[data-run="${ids[4]}"]`).waitFor({ state: 'detached' });
    await page.clock.runFor(10_000);
    await until('the server has deleted it', async () => (await call(server, 'GET', '/runs')).items.every((run) => run.id !== ids[4]));
    await view.close();
  });
});
