// What the tests know of the live page: its words in English and where its numbers stand.
import assert from 'node:assert/strict';
import { openPage } from './browser.mjs';
import { until } from './server.mjs';

/** The tick the header shows. */
export async function shownTick(page) {
  const text = await page.locator('.state .numbers').first().innerText();
  const found = /k\s*=\s*([\d,]+)/.exec(text);
  return found ? Number(found[1].replaceAll(',', '')) : -1;
}

/** Waits until the header's tick is past k; answers it. */
export function tickPast(page, k) {
  return until(`the header shows a tick past ${k}`, async () => {
    const now = await shownTick(page);
    return now > k ? now : 0;
  });
}

export const button = (page, name) => page.getByRole('button', { name, exact: true });

/** Starts an endless run by the API and opens its live page. */
export async function openLive(view, server, call, more = {}) {
  const run = await call(server, 'POST', '/runs', { scenario: 'consensus', seed: 7, pace: 20, patch: { time: { steps: null } }, ...more });
  await view.goto(`/live/${run.id}`);
  await tickPast(view.page, 0);
  return run;
}

/** A page with the live view of a run, from its first tick to `last`; `more` goes to the address. It may use the clipboard. */
export async function openRange(browser, server, id, last, more = '', options = {}) {
  const view = await openPage(browser, server, { permissions: ['clipboard-read', 'clipboard-write'], ...options });
  await view.goto(`/live/${id}?range=0-${last}${more}`);
  return view;
}

export const query = (page, key) => new URL(page.url()).searchParams.get(key);
/** The tick that the pinned cursor stands on, from the address. */
export const cursorOf = (page) => query(page, 'k');
export const rangeOf = (page) => query(page, 'range');

export async function csvOf(download) {
  const stream = await download.createReadStream();
  let text = '';
  for await (const piece of stream) text += piece;
  const lines = text.trim().split(/\r?\n/);
  assert.ok(lines.length > 1, 'the file has a header and rows');
  return lines.map((line) => line.split(','));
}
