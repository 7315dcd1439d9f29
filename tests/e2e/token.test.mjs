// A server with a token: the page asks for it, and works with it.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { openBrowser, openPage, refused } from './support/browser.mjs';
import { button } from './support/live.mjs';
import { folder, startServer } from './support/server.mjs';

const token = 'e2e-token-0123456789abcdef0123456789abcdef';

describe('a server with a token', () => {
  let browser;
  let place;
  let server;
  before(async () => {
    place = folder();
    const file = join(place.path, 'token');
    writeFileSync(file, `${token}\n`, { mode: 0o600 });
    server = await startServer({ db: join(place.path, 'vigil.db'), options: ['--no-demo', '--token-file', file] });
    browser = await openBrowser();
  });
  after(async () => {
    await browser?.close();
    await server?.stop();
    place?.remove();
  });

  test('the API refuses without it', async () => {
    assert.equal((await fetch(`${server.url}/api/v1/runs`)).status, 401);
    assert.equal((await fetch(`${server.url}/healthz`)).status, 200);
  });

  test('any page asks for it and then works', async () => {
    const view = await openPage(browser, server, { allowed: [refused(401), refused(403)] });
    const { page } = view;
    await view.goto('/runs');
    const dialog = page.getByRole('dialog', { name: 'This server asks for a token' });
    await dialog.waitFor();
    await dialog.getByLabel('Token').fill('wrong');
    await dialog.getByRole('button', { name: 'Open' }).click();
    await dialog.getByRole('alert').waitFor();
    await dialog.getByLabel('Token').fill(token);
    await dialog.getByRole('button', { name: 'Open' }).click();
    await page.getByRole('heading', { name: 'No run yet' }).waitFor();
    const cookies = await view.context.cookies();
    assert.ok(cookies.length === 1 && cookies[0].httpOnly && cookies[0].sameSite === 'Strict', JSON.stringify(cookies.map(({ name, httpOnly, sameSite }) => ({ name, httpOnly, sameSite }))));
    await view.close();
  });

  test('the page about Vigil has the form, too', async () => {
    const view = await openPage(browser, server, { allowed: [refused(401), refused(403)] });
    const { page } = view;
    await view.goto('/about');
    await page.getByRole('dialog', { name: 'This server asks for a token' }).waitFor();
    await page.keyboard.press('Escape');
    await page.locator('main').getByLabel('Token').fill(token);
    await button(page, 'Sign in').click();
    await page.locator('table[data-api] td').first().waitFor();
    await view.close();
  });
});
