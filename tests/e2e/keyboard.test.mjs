// A tour without a pointer.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { openPage } from './support/browser.mjs';
import { cursorOf, rangeOf, shownTick, tickPast } from './support/live.mjs';
import { call, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

/** Tab until what has the focus answers true. */
async function tabTo(page, what, holds, most = 250) {
  for (let i = 0; i < most; i += 1) {
    if (await page.evaluate(holds)) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`Tab never reached ${what}`);
}

describe('by keyboard alone', () => {
  let server;
  let browser;
  withSite((site) => ({ server, browser } = site));

  test('from the scenarios to a running experiment, through it, and to the list of runs', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/scenarios');
    await page.locator('[data-scenario="consensus"]').waitFor();

    await page.keyboard.press('Tab');
    assert.equal(await page.evaluate(() => document.activeElement?.classList.contains('skip')), true, 'the first stop skips to the content');
    await page.keyboard.press('Enter');
    await tabTo(page, 'the scenario', () => document.activeElement?.getAttribute('aria-label') === 'Open consensus');
    await page.keyboard.press('Enter');
    await page.locator('[id="f/time/dt"]').waitFor();

    await tabTo(page, 'the box for endless runs', () => document.activeElement?.getAttribute('aria-label') === 'steps: none');
    await page.keyboard.press('Space');
    await tabTo(page, 'the button that runs it', () => document.activeElement?.getAttribute('type') === 'submit' && document.activeElement.textContent?.trim() === 'Run');
    await page.keyboard.press('Enter');
    await page.waitForURL(/\/live\/\d+/);
    const id = /\/live\/(\d+)/.exec(page.url())[1];
    await tickPast(page, 5);

    await page.keyboard.press('Space');
    await until('Space pauses', async () => (await call(server, 'GET', `/runs/${id}`)).state === 'paused');
    await page.keyboard.press('ArrowLeft');
    await until('the arrow pins a cursor', () => cursorOf(page));
    const held = rangeOf(page);
    await page.keyboard.press('+');
    await until('plus zooms', () => rangeOf(page) !== held);
    const k = await shownTick(page);
    assert.equal(k, Number(cursorOf(page)));
    await page.keyboard.press('l');
    await until('l goes back to live', () => cursorOf(page) === null);
    await page.keyboard.press('Space');
    await until('Space goes on', async () => (await call(server, 'GET', `/runs/${id}`)).state === 'running');

    await page.keyboard.press('?');
    await page.getByRole('dialog', { name: 'Keyboard' }).waitFor();
    await page.keyboard.press('Escape');
    await page.locator('dialog[open]').waitFor({ state: 'detached' });
    const theme = await page.locator('html').getAttribute('data-theme');
    await page.keyboard.press('t');
    await until('t changes the theme', async () => (await page.locator('html').getAttribute('data-theme')) !== theme);

    await until('g r leads to the runs', async () => {
      await page.keyboard.press('g');
      await page.keyboard.press('r');
      return new URL(page.url()).pathname === '/runs';
    });
    await page.locator(`tr[data-run="${id}"]`).waitFor();
    await tabTo(page, 'the query', () => document.activeElement?.id === 'run-query');
    await page.keyboard.type('state:running');
    await page.keyboard.press('Enter');
    await until('typing in a field is not a shortcut', () => new URL(page.url()).searchParams.get('q') === 'state:running');
    await page.locator(`tr[data-run="${id}"]`).waitFor();
    await view.close();
    await call(server, 'DELETE', `/runs/${id}`);
  });
});
