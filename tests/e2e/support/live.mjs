// What the tests know of the live page: its words in English and where its numbers stand.
import assert from 'node:assert/strict';
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

/** The tick that the pinned cursor stands on, from the address. */
export const cursorOf = (page) => new URL(page.url()).searchParams.get('k');
export const rangeOf = (page) => new URL(page.url()).searchParams.get('range');

export async function csvOf(download) {
  const stream = await download.createReadStream();
  let text = '';
  for await (const piece of stream) text += piece;
  const lines = text.trim().split(/\r?\n/);
  assert.ok(lines.length > 1, 'the file has a header and rows');
  return lines.map((line) => line.split(','));
}
