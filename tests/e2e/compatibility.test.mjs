// Which lane meets which attack, on the scenario's page; from there an attack into the scenario and into a run.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { button } from './support/live.mjs';
import { call, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

describe('attacks and lanes', () => {
  let server;
  let browser;
  withSite((site) => ({ server, browser } = site));

  const opened = async (view) => {
    await view.page.getByRole('heading', { name: 'Attacks and lanes' }).click();
    const table = view.page.getByRole('group', { name: 'Attacks and lanes' }).getByRole('table');
    await table.waitFor();
    return table;
  };

  test('says what the server says, with the reasons', async () => {
    const view = await openPage(browser, server);
    await view.goto('/scenarios/replay-mixed');
    const table = await opened(view);
    const answer = await call(server, 'GET', '/scenarios/replay-mixed/compatibility');
    const expected = answer.rows.filter((row) => row.reason === null);
    const rows = await table.locator('tbody tr').evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
    assert.equal(rows.length, expected.length);
    expected.forEach((row, i) => {
      assert.equal(rows[i][0], row.attack);
      answer.lanes.forEach(({ id }, l) => assert.equal(/^\d+$/.test(rows[i][l + 3]), row.cells[id].meets === null, `${row.attack} ${id}`));
    });
    await view.page.getByRole('checkbox', { name: 'Also attacks that act nowhere here' }).check();
    await until('all rows', async () => (await table.locator('tbody tr').count()) === answer.rows.length);
    await view.page.getByRole('list', { name: 'Reasons' }).getByText('the network has no links').waitFor();
    await checkAxe(view.page);
    await view.close();
  });

  test('follows what is changed in the form, and puts an attack into the scenario that then runs', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/scenarios/replay-mixed');
    await opened(view);
    await button(page, 'Add stealthy on sensor:1 to the scenario').click();
    await page.getByText('stealthy is in the scenario as stealthy.').waitFor();
    await page.getByRole('textbox', { name: 'Seed' }).fill('4');
    await button(page, 'Run').click();
    await page.waitForURL(/\/live\/\d+/);
    const id = /\/live\/(\d+)/.exec(page.url())[1];
    const run = await call(server, 'GET', `/runs/${id}`);
    assert.equal(run.document.adversary.stealthy.type, 'stealthy');
    assert.deepEqual(run.document.adversary.stealthy.on, ['sensor:1']);
    await view.close();
  });
});
