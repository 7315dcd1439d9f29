// A server and a browser for a group of tests: there before its first test, gone after its last.
import { after, before } from 'node:test';
import { openBrowser } from './browser.mjs';
import { startServer } from './server.mjs';

/** Call inside describe(). `use` takes { server, browser } and may prepare more, before the first test. */
export function withSite(use, options = ['--no-demo']) {
  let server;
  let browser;
  before(async () => {
    server = await startServer({ options });
    browser = await openBrowser();
    await use({ server, browser });
  });
  after(async () => {
    await browser?.close();
    await server?.stop();
  });
}
