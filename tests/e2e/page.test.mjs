// What holds for every page: alive at once, small, quiet, in both languages and themes, at any width.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { checkAxe, violations } from './support/axe.mjs';
import { openPage, refused } from './support/browser.mjs';
import { button, tickPast } from './support/live.mjs';
import { said } from './support/said.mjs';
import { call, dist, finishedRun, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

describe('every page', () => {
  let server;
  let browser;
  let demo;
  let finished;

  withSite(async (site) => {
    ({ server, browser } = site);
    demo = await until('the demo runs', async () => (await call(server, 'GET', '/server')).demo);
    finished = (await finishedRun(server, { scenario: 'consensus', seed: 3 })).id;
  }, []);

  const pages = () => ['/', `/live/${demo}`, '/runs', `/runs/${finished}`, '/scenarios', '/scenarios/consensus', '/about', '/nowhere'];
  /** What has to be there before a page counts as shown. */
  async function ready(page, path) {
    if (path.startsWith('/live') || /^\/runs\/\d/.test(path)) await page.locator('.state .numbers').first().waitFor();
    else if (path === '/runs') await page.locator('tr[data-run]').first().waitFor();
    else if (path === '/scenarios') await page.locator('[data-scenario]').first().waitFor();
    else if (path.startsWith('/scenarios/')) await page.locator('[id="f/time/dt"]').waitFor();
    else if (path === '/about') await page.locator('table[data-api] td').first().waitFor();
    else await page.getByRole('heading', { level: 1 }).first().waitFor();
  }

  test('the first page leads to something alive', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/');
    await page.locator(`a[href*="/live/${demo}"]`).first().waitFor();
    await page.locator(`main a[href*="/live/${demo}"]`).first().click();
    const k = await tickPast(page, 0);
    await tickPast(page, k);
    await view.close();
  });

  test('the first load takes at most 120 kB of JavaScript, gzipped', async () => {
    const view = await openPage(browser, server);
    const scripts = new Set();
    view.context.on('response', (response) => {
      const { pathname } = new URL(response.url());
      if (pathname.endsWith('.js')) scripts.add(pathname);
    });
    await view.goto('/');
    await view.page.getByRole('heading', { level: 1 }).first().waitFor();
    await view.page.waitForLoadState('load');
    const sizes = [...scripts].map((path) => gzipSync(readFileSync(join(dist, path)), { level: 9 }).length);
    const total = sizes.reduce((sum, size) => sum + size, 0);
    assert.ok(sizes.length > 0, 'scripts were seen');
    assert.ok(total <= 120_000, `${total} bytes in ${scripts.size} files`);
    await view.close();
  });

  test('the policy forbids inline code and foreign origins', async () => {
    const response = await fetch(`${server.url}/`);
    const policy = response.headers.get('content-security-policy') ?? '';
    assert.match(policy, /default-src 'self'|default-src 'none'/);
    assert.doesNotMatch(policy, /unsafe-inline|unsafe-eval/);
  });

  test('the language switches, stays, and reaches the lang attribute', async () => {
    const view = await openPage(browser, server, { lang: null });
    const { page } = view;
    await page.goto(`${server.url}/runs`);
    await page.getByRole('heading', { level: 1, name: 'Runs' }).waitFor();
    assert.equal(await page.locator('html').getAttribute('lang'), 'en');
    await button(page, '中文: switch to Chinese').click();
    await page.getByRole('heading', { level: 1, name: '运行' }).waitFor();
    assert.equal(await page.locator('html').getAttribute('lang'), 'zh-CN');
    await page.goto(`${server.url}/scenarios`);
    await page.getByRole('heading', { level: 1, name: '场景' }).waitFor();
    for (const path of pages()) {
      await page.goto(`${server.url}${path}`);
      await ready(page, path);
      await said(page.locator('main'), /\p{Script=Han}/u);
    }
    await view.close();
  });

  test('the theme switches and stays', async () => {
    const view = await openPage(browser, server, { theme: null, colorScheme: 'dark' });
    const { page } = view;
    const theme = () => page.locator('html').getAttribute('data-theme');
    await page.goto(`${server.url}/runs`);
    await page.locator('tr[data-run]').first().waitFor();
    assert.equal(await theme(), 'dark', 'as the system');
    await page.getByRole('button', { name: 'Theme: as the system' }).click();
    await until('it is light', async () => (await theme()) === 'light');
    await page.goto(`${server.url}/about`);
    await page.getByRole('heading', { level: 1 }).first().waitFor();
    assert.equal(await theme(), 'light', 'kept');
    await page.getByRole('button', { name: 'Theme: light' }).click();
    await until('it is dark', async () => (await theme()) === 'dark');
    await view.close();
  });

  test('no page scrolls sideways at 390 px', async () => {
    const view = await openPage(browser, server, { width: 390, height: 844, allowed: [refused(404)] });
    const wide = [];
    for (const path of pages()) {
      await view.goto(path);
      await ready(view.page, path);
      const { scroll, client } = await view.page.evaluate(() => ({
        scroll: Math.max(document.documentElement.scrollWidth, document.querySelector('main')?.scrollWidth ?? 0),
        client: document.documentElement.clientWidth,
      }));
      if (scroll > client) wide.push(`${path}: ${scroll} > ${client}`);
    }
    assert.deepEqual(wide, []);
    await view.close();
  });

  for (const theme of ['light', 'dark']) {
    for (const lang of ['en', 'zh']) {
      test(`axe finds nothing, ${theme}, ${lang}`, async () => {
        const view = await openPage(browser, server, { theme, lang, allowed: [refused(404)] });
        const found = {};
        for (const path of pages()) {
          await view.goto(path);
          await ready(view.page, path);
          const here = await violations(view.page);
          if (here.length > 0) found[path] = here;
        }
        assert.deepEqual(found, {});
        await view.close();
      });
    }
  }

  test('axe finds nothing in dialogs, in a refused query and on a run that is missing', async () => {
    const view = await openPage(browser, server, { allowed: [refused(404), refused(400), refused(422)] });
    const { page } = view;
    await view.goto(`/live/${demo}`);
    await tickPast(page, 0);
    for (const name of ['Attack a link', 'Parameters', 'Keyboard and help']) {
      await button(page, name).click();
      await page.locator('dialog[open]').waitFor();
      await checkAxe(page, `dialog ${name}`);
      await page.keyboard.press('Escape');
      await page.locator('dialog[open]').waitFor({ state: 'detached' });
    }
    await view.goto('/runs?q=seed:(');
    await page.locator('#run-query-problem').waitFor();
    await checkAxe(page, 'a refused query');
    await view.goto('/runs/999999');
    await page.locator('main').getByText(/\S/).first().waitFor();
    await checkAxe(page, 'a run that is missing');
    await view.goto('/scenarios/nothing');
    await page.getByRole('alert').first().waitFor();
    await checkAxe(page, 'a scenario that is missing');
    await view.close();
  });
});
