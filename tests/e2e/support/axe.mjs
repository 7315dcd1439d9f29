import assert from 'node:assert/strict';
import { axeSource } from './packages.mjs';

const tags = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];

/** Every violation of WCAG 2.2 A/AA or best practice. */
export async function violations(page) {
  // Through the debugger, not a script element: the page's policy stays in force for everything else.
  const present = await page.evaluate(() => 'axe' in globalThis);
  if (!present) await page.evaluate(axeSource);
  return page.evaluate(async (run) => {
    const result = await globalThis.axe.run(document, { runOnly: { type: 'tag', values: run }, resultTypes: ['violations'] });
    return result.violations.map(({ id, help, nodes }) => ({ id, help, nodes: nodes.slice(0, 4).map(({ target, failureSummary }) => `${target.join(' ')}: ${failureSummary}`) }));
  }, tags);
}

export async function checkAxe(page, what) {
  assert.deepEqual(await violations(page), [], `axe on ${what}`);
}
