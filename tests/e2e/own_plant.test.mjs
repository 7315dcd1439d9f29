// A linear plant of one's own: pasted, checked as one types, run, shared, saved, copied, taken along.
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage, refused } from './support/browser.mjs';
import { button, query } from './support/live.mjs';
import { said } from './support/said.mjs';
import { call, folder, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

const cell = (page, name, row, column) => page.getByRole('textbox', { name: `${name}, row ${row}, column ${column}`, exact: true });
const size = (page, name) => page.locator('#linear-plant').getByRole('spinbutton', { name: new RegExp(`^${name} `) });
const state = (page) => page.locator('[data-check]');
const lane = (page, method) => page.locator('#linear-lanes').getByRole('checkbox', { name: new RegExp(`^${method} `) });

/** Puts text on the clipboard and pastes it into a cell, as from a spreadsheet. */
async function paste(page, place, text) {
  await page.evaluate((copied) => navigator.clipboard.writeText(copied), text);
  await place.focus();
  await page.keyboard.press('Control+v');
}

const values = (page, name, rows, columns) =>
  Promise.all(Array.from({ length: rows }, (_, i) => Promise.all(Array.from({ length: columns }, (__, j) => cell(page, name, i + 1, j + 1).inputValue()))));

describe('a linear plant of one’s own', () => {
  let server;
  let browser;
  withSite((site) => ({ server, browser } = site));

  const open = async (path, options = {}) => {
    const view = await openPage(browser, server, { permissions: ['clipboard-read', 'clipboard-write'], ...options });
    await view.goto(path);
    await view.page.locator('#linear-plant').waitFor();
    return view;
  };
  /** The file that a press of a button gives. */
  async function exported(page) {
    const [download] = await Promise.all([page.waitForEvent('download'), button(page, 'Export a file').click()]);
    return { name: download.suggestedFilename(), document: JSON.parse(await readFile(await download.path(), 'utf8')) };
  }

  test('pasted from a spreadsheet, given a lane and one that attacks spare, run and found again', async () => {
    const view = await openPage(browser, server, { permissions: ['clipboard-read', 'clipboard-write'] });
    const { page } = view;
    await view.goto('/scenarios');
    await page.getByRole('link', { name: 'Describe a system of your own' }).click();
    await page.getByRole('radio', { name: 'Linear plant with sensors' }).check();
    await page.locator('#linear-plant').waitFor();
    await page.getByRole('combobox', { name: 'Start from' }).selectOption('an empty system');
    await until('the empty system is there', async () => (await cell(page, 'A', 1, 1).inputValue()) === '0' && query(page, 'start') === 'empty');
    await paste(page, cell(page, 'A', 1, 1), '0.9\t0.1\t0\n0\t0.8\t0.1\n0.05\t0\t0.7');
    await until('the plant grew', async () => (await size(page, 'n').inputValue()) === '3');
    await paste(page, cell(page, 'C of node 1', 1, 1), '1\t0\t0\n0\t0\t1');
    await until('the sensor grew', async () => (await cell(page, 'C of node 1', 2, 3).inputValue()) === '1');
    await paste(page, cell(page, 'Q', 1, 1), '0,01\t0\t0\n0\t0,01\t0\n0\t0\t0,01');
    await page.getByRole('textbox', { name: 'Ticks' }).fill('40');
    await said(state(page), /It lacks a lane/);
    await lane(page, 'local_ekf').check();
    await button(page, 'Add a lane of local_ekf spared by attacks').click();
    await page.getByText('Attacks and lanes').click();
    await page.getByRole('button', { name: /bias.*sensor:1/ }).first().click();
    await page.locator('[id="f/adversary/bias"] summary').first().click();
    await until('the attack is on the only sensor', async () => /sensor:1/.test(await page.locator('[id="f/adversary/bias/on"]').inputValue()));
    await said(state(page), /It would start/);
    await said(page.locator('[data-node="1"]').first(), /rank 3 of 3/);
    await button(page, 'Run it').click();
    await page.waitForURL(/\/live\/\d+/);
    const id = /\/live\/(\d+)/.exec(page.url())[1];
    await page.locator('canvas').first().waitFor();
    const run = await runUntil(server, id, 'finished');
    assert.equal(run.progress.k, 40);
    assert.deepEqual(run.document.plant.params.A, [[0.9, 0.1, 0], [0, 0.8, 0.1], [0.05, 0, 0.7]]);
    assert.equal(run.document.lanes.local_ekf_clean.adversary, false);
    assert.ok(run.metrics.some((metric) => metric.lane === 'local_ekf_clean' && Number.isFinite(metric.value)), 'the spared lane has its figures');
    await page.goBack();
    await until('the matrices are there again', async () => (await size(page, 'n').inputValue()) === '3' && (await cell(page, 'A', 3, 1).inputValue()) === '0.05');
    await page.getByRole('link', { name: `Run ${id} of this description` }).waitFor();
    await view.close();
  });

  test('with an undetectable pair is told which mode nobody sees; a wrong covariance is refused at its place', async () => {
    const view = await open('/system?kind=linear&start=empty', { allowed: [refused(422)] });
    const { page } = view;
    await paste(page, cell(page, 'A', 1, 1), '1.1\t0\n0\t0.5');
    await paste(page, cell(page, 'C of node 1', 1, 1), '[0, 1]\n');
    await until('C is there', async () => (await cell(page, 'C of node 1', 1, 2).inputValue()) === '1');
    await said(page.locator('#linear-nodes'), /1\.1/);
    await said(page.locator('[data-node="1"]').first(), /rank 1 of 2; not seen: 1\.1/);
    await page.getByText(/\d+ methods do not fit/).click();
    const mixed = page.locator('#unfit-mixed_filter');
    await said(mixed, /not here: .*(C|detect|see)/);
    assert.equal(await lane(page, 'mixed_filter').isDisabled(), true);
    await cell(page, 'R of node 1', 1, 1).fill('-1');
    const place = page.locator('[id="f/nodes/1/sensor/params/R"]');
    await said(place.getByRole('alert'), /R/);
    assert.equal(await button(page, 'Run it').isDisabled(), true);
    await cell(page, 'R of node 1', 1, 1).fill('1');
    await until('the refusal is gone', async () => (await place.getByRole('alert').count()) === 0);
    // Seen, it can be estimated.
    await cell(page, 'C of node 1', 1, 1).fill('1');
    await said(page.locator('[data-node="1"]').first(), /rank 2 of 2/);
    await view.close();
  });

  test('is shared by a link that no server sees, and is the same in another browser', async () => {
    const view = await open('/system?kind=linear&start=chain');
    const { page } = view;
    await page.getByRole('button', { name: 'Nodes 1 and 3' }).focus();
    await page.keyboard.press('Space');
    await until('the pair is joined', async () => (await page.getByRole('button', { name: 'Nodes 1 and 3' }).getAttribute('aria-pressed')) === 'true');
    await cell(page, 'A', 4, 4).fill('0.123456789012345');
    await button(page, 'Copy a link').click();
    await page.getByText(/^Copied: [\d,]+ characters/).waitFor();
    const link = await page.evaluate(() => navigator.clipboard.readText());
    const { document } = await exported(page);
    const other = await openPage(browser, server);
    const sent = [];
    other.page.on('request', (request) => sent.push(request.url()));
    await other.page.goto(link);
    await until('the same matrix is there', async () => (await cell(other.page, 'A', 4, 4).count()) === 1 && (await cell(other.page, 'A', 4, 4).inputValue()) === '0.123456789012345');
    assert.deepEqual((await exported(other.page)).document, document);
    assert.deepEqual(document.network.edges, [['1', '2'], ['2', '3'], ['3', '4'], ['1', '3']]);
    assert.ok(sent.every((url) => !url.includes('doc=') || url.includes('#')), 'no request carries the document in its address');
    await other.close();
    await view.close();
  });

  test('is saved, copied, exported and brought back from its file', async () => {
    const view = await open('/system?kind=linear&start=feedback');
    const { page } = view;
    await said(state(page), /It would start/);
    await page.getByText('Save as your own').click();
    await page.getByRole('textbox', { name: 'Name (a-z, 0-9, -)' }).fill('held');
    await page.getByRole('textbox', { name: 'Title', exact: true }).fill('Held by feedback');
    await button(page, 'Save').click();
    await until('the address has it', () => query(page, 'scenario') === 'held');
    await button(page, 'Duplicate').last().click();
    await until('the address has the copy', () => query(page, 'scenario') === 'held-2');
    const stored = await call(server, 'GET', '/scenarios/held-2');
    assert.deepEqual(stored.controller.params.K, [[0.6, 0.2]]);
    assert.equal(stored.title.en, 'Held by feedback (held-2)');
    await cell(page, 'K', 1, 2).fill('0.3');
    await said(state(page), /It would start/);
    const file = await exported(page);
    assert.equal(file.name, 'held-2.json');
    assert.deepEqual(file.document.controller.params.K, [[0.6, 0.3]]);
    await button(page, 'Save held-2 again').click();
    await page.getByText('held-2 is saved.').waitFor();
    assert.deepEqual((await call(server, 'GET', '/scenarios/held-2')).controller.params.K, [[0.6, 0.3]]);
    const place = folder();
    try {
      await writeFile(join(place.path, 'mine.json'), JSON.stringify({ ...file.document, time: { dt: 0.2, steps: 33 } }));
      await page.locator('input[type=file]').setInputFiles(join(place.path, 'mine.json'));
      await until('the file is in the form', async () => (await page.getByRole('textbox', { name: 'Ticks' }).inputValue()) === '33');
    } finally {
      place.remove();
    }
    await view.goto('/scenarios/held');
    await page.getByRole('link', { name: 'Edit its matrices' }).click();
    await until('its matrices are there', async () => (await cell(page, 'K', 1, 2).count()) === 1 && (await cell(page, 'K', 1, 2).inputValue()) === '0.2');
    assert.deepEqual(await values(page, 'A', 2, 2), [['1.1', '0.2'], ['0', '0.8']]);
    await view.close();
  });

  for (const [theme, lang, width] of [['light', 'en', 1440], ['dark', 'zh', 1024], ['light', 'zh', 390]]) {
    test(`nothing for axe to say: ${theme}, ${lang}, ${width} px`, async () => {
      const view = await open('/system?kind=linear&start=chain', { theme, lang, width });
      await view.page.locator('[data-node="joint"]').waitFor();
      await view.page.locator('[data-check="good"]').waitFor();
      for (const summary of await view.page.locator('#linear-lanes summary').all()) await summary.click();
      await checkAxe(view.page, `the form of a linear plant, ${theme} ${lang} ${width}`);
      const overflow = await view.page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      assert.ok(overflow <= 0, `nothing sticks out sideways: ${overflow} px`);
      await view.close();
    });
  }
});
