// A job of the papers whose server is killed in the middle: it goes on by itself, and the page that was open says so.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { lost, openBrowser, openPage } from './support/browser.mjs';
import { button } from './support/live.mjs';
import { call, folder, startServer, until } from './support/server.mjs';

describe('a job of the papers', () => {
  let browser;
  let place;
  let server;
  const options = ['--no-demo'];
  const job = async () => (await call(server, 'GET', '/papers')).job;

  before(async () => {
    browser = await openBrowser();
    place = folder();
    server = await startServer({ db: `${place.path}/vigil.db`, options });
  });
  after(async () => {
    await browser?.close();
    await server?.stop();
    place?.remove();
  });

  test('goes on after the server was killed, and runs no item twice', async () => {
    const view = await openPage(browser, server, { allowed: [lost] });
    await view.goto('/papers');
    const { page } = view;
    await page.getByRole('spinbutton', { name: 'Runs of each campaign' }).fill('100');
    for (const key of ['000/fig1', '003/fig5', '004/eq4-33']) await page.getByRole('checkbox', { name: `Choose ${key}`, exact: true }).check();
    await button(page, 'Run the 3 chosen').click();
    await until('the second item is under way', async () => (await job())?.current === '003/fig5');
    const first = (await call(server, 'GET', '/papers/000/fig1')).ended;
    await server.kill();
    server = await startServer({ db: server.db, port: server.port, options });
    const taken = await job();
    assert.equal(taken.state, 'running');
    assert.equal(taken.taken_up.done, 1);
    await page.getByText('The last job is done. Items: 3; runs of each campaign: 100; first seed: 1.').waitFor({ timeout: 120_000 });
    assert.deepEqual((await job()).failed, []);
    assert.equal((await call(server, 'GET', '/papers/000/fig1')).ended, first, 'what was done is not run again');
    for (const key of ['003/fig5', '004/eq4-33']) assert.notEqual((await call(server, 'GET', `/papers/${key}`)).verdict, null);
    await view.close();
  });
});
