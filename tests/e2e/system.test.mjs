// A system of one's own by its matrices: described, refused where it has to be, given gains, run, saved, opened again.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage, refused } from './support/browser.mjs';
import { button } from './support/live.mjs';
import { counted, said } from './support/said.mjs';
import { call, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

const cell = (page, matrix, subsystem, row, column) => page.getByRole('textbox', { name: `${matrix} of subsystem ${subsystem}, row ${row}, column ${column}`, exact: true });
const size = (page, subsystem, name) => page.locator(`#subsystem-${subsystem}`).getByRole('spinbutton', { name: new RegExp(`^${name} `) });

/** Puts text on the clipboard and pastes it into a cell, as from a spreadsheet. */
async function paste(page, place, text) {
  await page.evaluate((copied) => navigator.clipboard.writeText(copied), text);
  await place.focus();
  await page.keyboard.press('Control+v');
}

describe('a system of one’s own', () => {
  let server;
  let browser;
  withSite((site) => ({ server, browser } = site));

  const open = async (path, options = {}) => {
    const view = await openPage(browser, server, { permissions: ['clipboard-read', 'clipboard-write'], ...options });
    await view.goto(path);
    await view.page.locator('#subsystem-1').waitFor();
    return view;
  };

  test('of two subsystems of different sizes, coupled one way, pasted, synthesised, saved and run', async () => {
    const form = await openPage(browser, server, { permissions: ['clipboard-read', 'clipboard-write'] });
    const { page } = form;
    await form.goto('/scenarios');
    await page.getByRole('link', { name: 'Describe a system of your own' }).click();
    await page.locator('#subsystem-1').waitFor();
    await page.getByRole('spinbutton', { name: /^k / }).fill('2');
    await paste(page, cell(page, 'A', 1, 1, 1), '-1\t0.5\t0\n0\t-2\t1\n0.2\t0\t-1.5');
    await until('the subsystem grew', async () => (await size(page, 1, 'n').inputValue()) === '3');
    await paste(page, cell(page, 'C', 1, 1, 1), '1\t0\t0\n0\t1\t0');
    await paste(page, cell(page, 'D', 1, 1, 1), '[1; 0; 0]');
    await size(page, 1, 'g').fill('1');
    await paste(page, cell(page, 'G', 1, 1, 1), '0\n1');
    await paste(page, cell(page, 'A', 2, 1, 1), '-1 0.3\n0 -1');
    await paste(page, cell(page, 'C', 2, 1, 1), '1 0\n0 1');
    await paste(page, cell(page, 'D', 2, 1, 1), '0\n1');
    await page.getByRole('combobox', { name: 'From subsystem' }).selectOption('2');
    await page.getByRole('combobox', { name: 'to subsystem' }).selectOption('1');
    await page.getByRole('checkbox', { name: 'both ways' }).uncheck();
    await button(page, 'Add a coupling').click();
    await page.getByRole('textbox', { name: 'H from 2 to 1, row 1, column 2', exact: true }).fill('0.1');
    await page.getByRole('textbox', { name: 'attack w1 of subsystem 1, line 1, sine', exact: true }).fill('1');
    await page.getByRole('textbox', { name: 'attack w1 of subsystem 1, line 1, rate, rad/s', exact: true }).fill('2');
    await page.getByRole('textbox', { name: 'Duration, s' }).fill('2');
    await page.getByRole('checkbox', { name: /^intermediate_fast/ }).check();
    assert.equal(await button(page, 'Run it').isDisabled(), true);
    await button(page, 'Synthesise').click();
    await page.getByText('Every lane has gains whose certificate holds.').waitFor();
    await counted(page.locator('[data-design]'), 2);
    await page.getByText('The certificate holds').first().waitFor();
    await page.getByText('Save as your own').click();
    await page.getByRole('textbox', { name: 'Name (a-z, 0-9, -)' }).fill('two-of-mine');
    await button(page, 'Save').click();
    await until('the address has the saved scenario', () => new URL(page.url()).searchParams.get('scenario') === 'two-of-mine');
    await button(page, 'Run it').click();
    await page.waitForURL(/\/live\/\d+/);
    const id = /\/live\/(\d+)/.exec(page.url())[1];
    await page.locator('.state-errors canvas').first().waitFor();
    const run = await runUntil(server, id, 'finished');
    assert.equal(run.progress.k, 2000);
    assert.deepEqual(Object.keys(run.document.plant.params.couplings), ['2-1']);
    assert.deepEqual(Object.keys(run.design).toSorted(), ['intermediate_fast', 'intermediate_ref']);
    const error = run.metrics.find((metric) => metric.lane === 'intermediate_fast' && metric.node === '1' && metric.name === 'rms_attack_error').value;
    assert.ok(error < 0.1, `the attack is found: ${error}`);
    await form.goto('/system?scenario=two-of-mine');
    await until('the matrices are there again', async () => (await cell(page, 'A', 1, 3, 1).inputValue()) === '0.2');
    assert.equal(await page.getByRole('textbox', { name: 'H from 2 to 1, row 1, column 2', exact: true }).inputValue(), '0.1');
    await form.goto('/scenarios/two-of-mine');
    await page.getByRole('link', { name: 'Edit its matrices' }).click();
    await page.locator('#subsystem-2').waitFor();
    await form.close();
  });

  test('that cannot be observed is refused at the matrix, with the reason', async () => {
    const view = await open('/system?start=undetectable', { allowed: [refused(422)] });
    const { page } = view;
    await button(page, 'Synthesise').click();
    const place = page.locator('[id="f/plant/params/subsystems/1/D"]');
    await said(place.getByRole('alert'), /invariant zero/);
    await until('the focus is in the matrix', () => page.evaluate(() => document.getElementById('f/plant/params/subsystems/1/D').contains(document.activeElement)));
    assert.equal(await button(page, 'Run it').isDisabled(), true);
    assert.equal((await call(server, 'GET', '/runs')).items.filter(({ state }) => state !== 'finished').length, 0);
    // An output of the attacked state makes it whole.
    await paste(page, cell(page, 'C', 1, 1, 1), '1\t0');
    await button(page, 'Synthesise').click();
    await page.getByText('Every lane has gains whose certificate holds.').waitFor();
    await view.close();
  });

  test('coupled too strongly gets no gains, and says why', async () => {
    const view = await open('/system?start=pair');
    const { page } = view;
    await page.getByRole('checkbox', { name: /^intermediate_fast/ }).uncheck();
    await page.locator('[id="f/plant/params/subsystems/1/tau"]').fill('5000');
    await button(page, 'Synthesise').click();
    await page.getByRole('alert').filter({ hasText: 'No certified gains for intermediate ref' }).waitFor();
    await said(page.getByRole('alert').filter({ hasText: 'No certified gains' }), /ref: \S+/);
    assert.equal(await button(page, 'Run it').isDisabled(), true);
    await view.close();
  });

  for (const [theme, lang, width] of [['light', 'en', 1440], ['dark', 'zh', 1024], ['light', 'zh', 390]]) {
    test(`nothing for axe to say: ${theme}, ${lang}, ${width} px`, async () => {
      const view = await open('/system?start=pair', { theme, lang, width });
      await view.page.locator('button[type=submit]').first().click();
      await view.page.locator('.result dl').first().waitFor();
      await checkAxe(view.page, `the form of a system, ${theme} ${lang} ${width}`);
      const overflow = await view.page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      assert.ok(overflow <= 0, `nothing sticks out sideways: ${overflow} px`);
      await view.close();
    });
  }
});
