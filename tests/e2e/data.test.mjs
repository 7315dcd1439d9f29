// Data of one's own, from the page: a table whose columns are mapped, rows pushed into a run, estimates computed elsewhere.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage, refused } from './support/browser.mjs';
import { csvOfRun, foreignTable, off } from './support/foreign.mjs';
import { button } from './support/live.mjs';
import { near } from './support/privacy.mjs';
import { number, said } from './support/said.mjs';
import { call, finishedRun, folder, root, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { panel } from './support/sparse.mjs';

const vigil = process.env.VIGIL_BINARY ?? join(root, 'build', 'release', 'vigil');
const seed = 5;
const csvFile = (name, text) => ({ name, mimeType: 'text/csv', buffer: Buffer.from(text) });

describe('data of one’s own', () => {
  let server;
  let browser;
  let table;
  let traced;
  const own = folder();
  withSite(async (site) => {
    ({ server, browser } = site);
    const simulated = await finishedRun(server, { scenario: 'consensus', seed: 11 });
    table = await foreignTable(server, simulated.id);
  });

  const signalOf = (page, column) => page.getByRole('combobox', { name: `Signal of ${column}`, exact: true });
  const traceText = async (id) => (await fetch(`${server.url}/api/v1/traces/${id}`, { headers: { Accept: 'text/csv' } })).text();

  async function openMapping(view, text = table.text) {
    const { page } = view;
    await view.goto('/scenarios');
    await page.locator('input[type=file][accept*=".txt"]').setInputFiles(csvFile('theirs.csv', text));
    await page.getByRole('combobox', { name: 'For the scenario' }).selectOption('consensus');
    await until('the names were guessed', async () => (await signalOf(page, 'Node 1: p').inputValue()) === 'sensor.1.p');
  }

  async function startOnPage(page, choose) {
    await choose();
    await page.getByRole('textbox', { name: 'Seed' }).fill(String(seed));
    await page.getByRole('radio', { name: 'as fast as possible' }).check();
    await button(page, 'Run').click();
    await page.waitForURL(/\/live\/\d+/);
    return /\/live\/(\d+)/.exec(page.url())[1];
  }

  test('a foreign table: names are guessed, the rest is chosen, the mapping is what the command line takes', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await openMapping(view);
    for (const [signal, name] of Object.entries(table.names)) if (name !== 'mystery') assert.equal(await signalOf(page, name).inputValue(), signal);
    assert.equal(await signalOf(page, 'what').inputValue(), '');
    assert.equal(await signalOf(page, 'Time').inputValue(), 'time');
    await signalOf(page, 'mystery').selectOption('sensor.1.p');
    await page.getByText('Two columns are sensor.1.p.').waitFor();
    assert.equal(await button(page, 'Store as a trace').isDisabled(), true);
    await signalOf(page, 'mystery').selectOption('sensor.2.q');
    await page.getByText('The trace brings the lane mine at 1').waitFor();

    const saving = page.waitForEvent('download');
    await button(page, 'Save the mapping').click();
    const path = await (await saving).path();
    const mapping = JSON.parse(readFileSync(path, 'utf8'));
    assert.deepEqual(mapping, { dt: 1, columns: table.names });
    await button(page, 'Nothing').click();
    await page.getByText('No column is a signal yet.').waitFor();
    await page.locator('input[type=file][aria-label="Load a mapping"]').setInputFiles({ name: 'm.json', mimeType: 'application/json', buffer: readFileSync(path) });
    await until('the mapping is back', async () => (await signalOf(page, 'mystery').inputValue()) === 'sensor.2.q');

    await button(page, 'Store as a trace').click();
    const [, id] = await said(page.locator('#traces [role=status]').first(), /Trace (\d+) is stored: 31 rows/);
    await page.getByText('It brings estimates computed elsewhere: mine').waitFor();
    writeFileSync(join(own.path, 'theirs.csv'), table.text);
    execFileSync(vigil, ['trace', 'table', join(own.path, 'theirs.csv'), '--map', path, '--out', join(own.path, 'trace.csv')]);
    assert.equal(await traceText(id), readFileSync(join(own.path, 'trace.csv'), 'utf8'), 'one implementation');

    traced = await startOnPage(page, async () => {
      await page.getByRole('link', { name: 'Run consensus on it' }).click();
      await until('the trace is chosen', async () => (await page.getByRole('combobox', { name: 'Input' }).inputValue()) === `trace:${id}`);
    });
    const run = await runUntil(server, traced, 'finished');
    assert.deepEqual(run.input, { trace: id });
    await view.close();
  });

  test('the lane computed elsewhere is scored and drawn among ours', async () => {
    const run = await call(server, 'GET', `/runs/${traced}`);
    const metric = run.metrics.find((one) => one.lane === 'mine' && one.name === 'rmse_position' && one.node === null);
    assert.ok(Math.abs(metric.value - Math.hypot(off.x, off.y)) < 1e-9, String(metric.value));
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/live/${traced}`);
    const figure = page.locator('.figure.lane', { hasText: 'mine' });
    near((await said(figure, new RegExp(`${number} cm`)))[1], metric.value);
    const chart = page.locator('.panel.errors canvas').last();
    await chart.waitFor();
    const picture = () => page.locator('.panel.errors .plot').screenshot();
    const before = await until('the chart stands still', async () => {
      const one = await picture();
      return one.equals(await picture()) && one;
    });
    await figure.click();
    await until('the lane is hidden', async () => (await figure.getAttribute('aria-pressed')) === 'false');
    await until('and its line is gone', async () => !(await picture()).equals(before));
    await view.close();
  });

  test('the same rows pushed from the page give the same lanes, bit for bit; run again, they do so again', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/scenarios/consensus');
    const id = await startOnPage(page, async () => {
      await page.getByRole('combobox', { name: 'Input' }).selectOption('ingest');
      assert.equal(await page.getByRole('textbox', { name: 'Seed' }).inputValue(), '', 'the server draws it');
      await page.getByRole('textbox', { name: 'Deadline, s' }).fill('0');
      await page.getByText('Seconds from 0.001 to 3600.').waitFor();
      await page.getByRole('textbox', { name: 'Deadline, s' }).fill('30');
      await page.getByRole('textbox', { name: 'More columns' }).fill(Object.keys(off).map((component) => `lane.mine.1.estimate.${component}`).join(' '));
    });
    const readings = panel(page, 'Readings');
    await readings.getByText(`${server.url}/api/v1/ingest/${id}`, { exact: true }).waitFor();
    await readings.getByText(`vigil push ${id} rows.csv --server ${server.url}`).waitFor();
    await readings.getByText('columns it takes').click();
    await readings.getByText('sensor.1.p, sensor.1.q').waitFor();
    const { input } = await call(server, 'GET', `/runs/${traced}`);
    const text = await traceText(input.trace);
    const [head, ...rows] = text.trim().split('\n');
    const choose = readings.locator('input[type=file]');
    await choose.setInputFiles(csvFile('half.csv', `${[head, ...rows.slice(0, 12)].join('\n')}\n`));
    await readings.getByText('half.csv: 12 rows accepted').waitFor();
    await said(readings.locator('dl'), /accepted\s+12[\s\S]*duplicate\s+0[\s\S]*closed up to\s+11/);
    await choose.setInputFiles(csvFile('wrong.csv', 'a,b\n1,2\n'));
    await readings.getByRole('alert').filter({ hasText: 'wrong.csv has no column k' }).waitFor();
    await choose.setInputFiles(csvFile('whole.csv', text));
    await until('the whole is pushed', async () => (await call(server, 'GET', `/runs/${id}`)).state === 'finished');
    await page.getByText('This run is over').waitFor();
    const lanes = ['lane.*'];
    const expected = await csvOfRun(server, traced, lanes);
    assert.equal(await csvOfRun(server, id, lanes), expected);

    await view.goto('/runs');
    await page.getByRole('checkbox', { name: `Select run ${id}`, exact: true }).check();
    await button(page, 'Run again').click();
    const [, again] = await said(page.getByText(/Started: run \d+\./), /run (\d+)\. Runs into which readings were pushed run again on the recorded rows/);
    const repeated = await runUntil(server, again, 'finished');
    assert.ok(repeated.input.trace, 'it runs on what was recorded, and does not simulate');
    assert.equal(await csvOfRun(server, again, lanes), expected);
    await view.close();
  });

  test('what is no number is refused with its line and column', async () => {
    const view = await openPage(browser, server, { allowed: [refused(422)] });
    const { page } = view;
    await openMapping(view);
    await signalOf(page, 'Node 1: p').selectOption('');
    await signalOf(page, 'what').selectOption('sensor.1.p');
    await button(page, 'Store as a trace').click();
    await page.getByRole('alert').filter({ hasText: 'line 2: column 1 (what) is "row 0"' }).waitFor();
    await page.locator('input[type=file][aria-label="Load a mapping"]').setInputFiles({ name: 'm.json', mimeType: 'application/json', buffer: Buffer.from('[]') });
    await page.getByText('This file is no mapping').waitFor();
    await button(page, 'Cancel').click();
    await page.getByRole('form', { name: /^Columns of/ }).waitFor({ state: 'detached' });
    await view.close();
  });

  for (const [theme, lang, width] of [['light', 'en', 1440], ['dark', 'zh', 1024], ['light', 'zh', 390]]) {
    test(`nothing for axe to say, nothing wider than the screen: ${theme}, ${lang}, ${width} px`, async () => {
      const view = await openPage(browser, server, { theme, lang, width });
      const { page } = view;
      // A few columns say as much as all of them; the form's own rows are looked at where it is tested.
      const short = table.text.split('\n').map((line) => line.split(',').slice(0, 5).join()).join('\n');
      const narrow = async (what, whole = true) => {
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true, `${what} at ${width}`);
        if (whole) await checkAxe(page, `${what}, ${theme} ${lang} ${width}`);
      };
      await view.goto('/scenarios');
      await page.locator('input[type=file][accept*=".txt"]').setInputFiles(csvFile('theirs.csv', short));
      await page.locator('form.map tbody select').first().waitFor();
      await narrow('the mapping');
      await view.goto('/scenarios/consensus');
      await page.locator('select').filter({ has: page.locator('option[value=ingest]') }).selectOption('ingest');
      await narrow('the run panel', width === 390);
      const { id } = await call(server, 'POST', '/runs', { scenario: 'consensus', input: 'ingest' });
      await view.goto(`/live/${id}`);
      await page.locator('.panel.readings dl').waitFor();
      await narrow('the readings');
      await view.close();
      await call(server, 'DELETE', `/runs/${id}`);
    });
  }
});
