// The server dies in the middle of a run and comes back on the same port with the same file.
import { after, before, describe, test } from 'node:test';
import { join } from 'node:path';
import { lost, openBrowser, openPage, refused } from './support/browser.mjs';
import { openLive, tickPast } from './support/live.mjs';
import { call, folder, startServer, until } from './support/server.mjs';

describe('a server that is killed', () => {
  let browser;
  let place;
  let server;
  before(async () => {
    place = folder();
    server = await startServer({ db: join(place.path, 'vigil.db'), options: ['--no-demo'] });
    browser = await openBrowser();
  });
  after(async () => {
    await browser?.close();
    await server?.stop();
    place?.remove();
  });

  test('the page says so, finds it again, and the run is marked as interrupted', async () => {
    const view = await openPage(browser, server, { allowed: [lost, refused(404), refused(409), refused(503)] });
    const { page } = view;
    const run = await openLive(view, server, call);
    await tickPast(page, 10);
    await server.kill();
    await page.getByText(/No connection to the server/).first().waitFor();

    server = await startServer({ db: server.db, port: server.port, options: ['--no-demo'] });
    await page.getByText(/No connection to the server/).first().waitFor({ state: 'detached' });
    await page.getByText(/The server stopped while this run was going on/).first().waitFor();
    await until('the log marks the run', async () => (await call(server, 'GET', `/runs/${run.id}`)).state === 'interrupted');

    await view.goto('/runs');
    await page.locator(`tr[data-run="${run.id}"]`, { hasText: 'interrupted' }).waitFor();
    await openLive(view, server, call);
    await view.close();
  });

  test('a demo that lives on resumes on the page by itself', async () => {
    await server.stop();
    server = await startServer({ db: server.db, port: server.port });
    const view = await openPage(browser, server, { allowed: [lost, refused(404), refused(503)] });
    const { page } = view;
    const demo = () => until('there is a demo', async () => (await call(server, 'GET', '/server')).demo);
    const first = await demo();
    await view.goto(`/live/${first}`);
    await tickPast(page, 3);
    await server.kill();
    await page.getByText(/No connection to the server/).first().waitFor();
    server = await startServer({ db: server.db, port: server.port });
    const second = await demo();
    await page.getByText(/No connection to the server/).first().waitFor({ state: 'detached' });
    if (second !== first) await page.getByRole('link', { name: 'Open the running demo' }).or(page.getByRole('button', { name: 'Open the running demo' })).click();
    const k = await tickPast(page, -1);
    await tickPast(page, k);
    await view.close();
  });
});
