// A browser whose pages are watched: nothing may leave the origin, break the policy, or be written to the console as an error.
import assert from 'node:assert/strict';
import { chromium } from './packages.mjs';
import { deadline } from './server.mjs';

const options = [
  '--no-sandbox',
  '--disable-quic',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-domain-reliability',
  '--disable-sync',
  '--no-first-run',
  '--no-default-browser-check',
  '--disable-dev-shm-usage',
];

export async function openBrowser() {
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: options, timeout: deadline });
}

/**
 * A page in a context of its own. `allowed`: console errors that belong to the test, e.g. a refused call. check() fails on
 * anything else that was seen.
 */
export async function openPage(browser, server, { allowed = [], lang = 'en', theme = 'light', width = 1440, height = 900, ...more } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, locale: 'en-GB', colorScheme: theme, acceptDownloads: true, ...more });
  context.setDefaultTimeout(deadline);
  context.setDefaultNavigationTimeout(deadline);
  const page = await context.newPage();
  const seen = [];
  page.on('pageerror', (error) => seen.push(`error: ${error.message}`));
  page.on('console', (message) => {
    if (message.type() === 'error' || /Content Security Policy/i.test(message.text())) seen.push(`console: ${message.text()} ${message.location().url}`);
  });
  context.on('request', (request) => {
    const url = new URL(request.url());
    const inside = url.origin === server.url || url.protocol === 'blob:' || url.protocol === 'data:';
    if (!inside) seen.push(`left the origin: ${request.url()}`);
  });
  const wrong = () => seen.filter((line) => !allowed.some((pattern) => pattern.test(line)));
  return {
    page,
    context,
    goto: (path) => page.goto(address(server, path, lang, theme)),
    check: () => assert.deepEqual(wrong(), [], 'the page stayed quiet and inside its origin'),
    close: async () => {
      await context.close();
      assert.deepEqual(wrong(), [], 'the page stayed quiet and inside its origin');
    },
  };
}

export function address(server, path, lang, theme) {
  const url = new URL(path, server.url);
  if (lang) url.searchParams.set('lang', lang);
  if (theme) url.searchParams.set('theme', theme);
  return url.href;
}

/** Makes the page's timers wait for page.clock.runFor(): no busy machine can be too slow for them. Before the first goto. */
export async function holdClock(page) {
  await page.clock.install();
  await page.clock.pauseAt(new Date(Date.now() + 1000));
}

/** For a call that the test wants refused: browsers write every 4xx to the console. */
export const refused = (status) => new RegExp(`status of ${status}`);
/** For the time in which there is no server. */
export const lost = /ERR_CONNECTION|ERR_INCOMPLETE_CHUNKED|ERR_EMPTY_RESPONSE|ERR_NETWORK|ERR_SOCKET|Failed to fetch/;
