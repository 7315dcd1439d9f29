// From the parameter form to a running experiment.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { holdClock, openPage, refused } from './support/browser.mjs';
import { button, tickPast } from './support/live.mjs';
import { said } from './support/said.mjs';
import { call, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

const field = (page, pointer) => page.locator(`[id="f${pointer}"]`);
const kTau = '/lanes/consensus/params/tau';

describe('scenario form', () => {
  let server;
  let browser;
  withSite((site) => ({ server, browser } = site));

  test('starts a run with a changed parameter', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/scenarios');
    await page.getByRole('link', { name: 'Open consensus', exact: true }).click();
    await field(page, kTau).fill('0.02');
    await page.getByRole('checkbox', { name: 'steps: none' }).check();
    await said(page.locator('[data-command]'), /^vigil run consensus --seed 1 .*--set lanes\.consensus\.params\.tau=0\.02/);
    await page.getByRole('textbox', { name: 'Seed' }).fill('42');
    await page.getByRole('textbox', { name: 'ticks per second' }).fill('20');
    await page.getByRole('textbox', { name: 'Tags' }).fill('e2e paper');
    await button(page, 'Run').click();
    await page.waitForURL(/\/live\/\d+/);
    const id = /\/live\/(\d+)/.exec(page.url())[1];
    await tickPast(page, 3);
    const run = await call(server, 'GET', `/runs/${id}`);
    assert.equal(run.document.lanes.consensus.params.tau, 0.02);
    assert.equal(run.document.time.steps, null);
    assert.equal(run.seed, 42);
    assert.equal(run.state, 'running');
    assert.deepEqual(run.tags, ['e2e', 'paper']);
    await view.close();
    await call(server, 'DELETE', `/runs/${id}`);
  });

  test('shows units, limits, defaults and meanings in the chosen language', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/scenarios/consensus');
    const row = page.locator('.row', { has: field(page, kTau) });
    await row.waitFor();
    const english = await row.innerText();
    assert.match(english, /≥ 0/);
    assert.match(english, /default 0\.01/);
    await button(page, '中文: switch to Chinese').click();
    await until('the meaning is Chinese', async () => /\p{Script=Han}/u.test(await row.locator('.name').innerText()));
    await said(row, /默认 0\.01/);
    await view.close();
  });

  test('finds a value out of range by itself and leads to it', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/scenarios/consensus');
    await field(page, kTau).fill('-1');
    await page.getByText('Allowed: ≥ 0.').waitFor();
    await field(page, '/time/dt').focus();
    await button(page, 'Run').click();
    await until('the faulty field has the focus', () => page.evaluate((id) => document.activeElement?.id === id, `f${kTau}`));
    assert.equal(await field(page, kTau).getAttribute('aria-invalid'), 'true');
    assert.equal((await call(server, 'GET', '/runs')).items.length, 0);
    await field(page, kTau).fill('one');
    await page.getByText('“one” is not a number.').waitFor();
    await view.close();
  });

  test("puts the server's refusal to the field it names", async () => {
    const view = await openPage(browser, server, { allowed: [refused(422), refused(400)] });
    const { page } = view;
    await view.goto('/scenarios/consensus');
    // Each is in range, their sum is not: only the server knows.
    await field(page, '/adversary/links/params/pdos').fill('0.7');
    await field(page, '/adversary/links/params/pfdi').fill('0.7');
    await button(page, 'Run').click();
    await until('a field of the attack has the focus', () => page.evaluate(() => document.activeElement?.id.startsWith('f/adversary/links')));
    await page.locator('.fault').first().waitFor();
    assert.equal((await call(server, 'GET', '/runs')).items.length, 0);
    await view.close();
  });

  test('takes pasted cells, and the address carries the changes', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/scenarios/consensus');
    const cells = field(page, '/noise/Q').locator('input');
    await cells.first().waitFor();
    await cells.first().evaluate((input) => {
      const data = new DataTransfer();
      data.setData('text', '2\t3\t4');
      input.dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true }));
    });
    await until('three cells are filled', async () => (await cells.evaluateAll((all) => all.map((one) => one.value).join())) === '2,3,4');
    await until('the address has the patch', () => JSON.parse(new URL(page.url()).searchParams.get('patch') ?? '{}').noise?.Q?.join() === '2,3,4');
    await page.reload();
    await cells.first().waitFor();
    assert.equal(await cells.evaluateAll((all) => all.map((one) => one.value).join()), '2,3,4');
    await button(page, 'Undo all changes').click();
    await until('the address is clean again', () => !new URL(page.url()).searchParams.has('patch'));
    await view.close();
  });

  test('adds, doubles and removes lanes', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/scenarios/consensus');
    await button(page, 'Duplicate consensus').click();
    await page.locator('[data-pointer="/lanes/consensus_2"]').waitFor();
    await page.locator('[data-pointer="/lanes/isolated"] > summary').click();
    await button(page, 'Remove isolated').click();
    await page.locator('[data-pointer="/lanes/isolated"]').waitFor({ state: 'detached' });
    await page.getByRole('radio', { name: 'as fast as possible' }).check();
    await button(page, 'Run').click();
    await page.waitForURL(/\/live\/\d+/);
    const run = await call(server, 'GET', `/runs/${/\/live\/(\d+)/.exec(page.url())[1]}`);
    const lanes = Object.keys(run.document.lanes);
    assert.ok(lanes.includes('consensus_2') && !lanes.includes('isolated'), lanes.join());
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('saves a scenario of its own; its title is text, not markup; deleting can be undone', async () => {
    const view = await openPage(browser, server, { allowed: [refused(404)] });
    const { page } = view;
    const title = '<img src=x onerror="document.title=1"> mine';
    await view.goto('/scenarios/consensus');
    await field(page, kTau).fill('0.03');
    await page.getByText('Save as your own').click();
    await page.getByRole('textbox', { name: 'Name (a-z, 0-9, -)' }).fill('mine');
    await page.getByRole('textbox', { name: 'Title' }).fill(title);
    await button(page, 'Save').click();
    await page.waitForURL(/\/scenarios\/mine/);
    await page.getByRole('heading', { level: 1, name: title }).waitFor();
    await holdClock(page);
    await view.goto('/scenarios');
    await page.getByRole('heading', { level: 3, name: title }).waitFor();
    assert.equal(await page.locator('main img, header img').count(), 0);
    assert.notEqual(await page.title(), '1');

    await button(page, 'Delete mine').click();
    await page.locator('[data-scenario="mine"]').waitFor({ state: 'detached' });
    await button(page, 'Undo').click();
    await page.locator('[data-scenario="mine"]').waitFor();
    assert.equal((await call(server, 'GET', '/scenarios/mine')).lanes?.consensus?.params?.tau, 0.03);
    await page.clock.runFor(20_000);
    await button(page, 'Delete mine').click();
    await page.locator('[data-scenario="mine"]').waitFor({ state: 'detached' });
    await page.clock.runFor(10_000);
    await until('the server has forgotten it', async () => !(await call(server, 'GET', '/scenarios')).items.some((one) => one.id === 'mine'));
    await view.close();
  });

  test('stores a trace and offers it as input', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto('/scenarios');
    const rows = Array.from({ length: 5 }, (_, k) => `${k},${k},${k === 0 ? '' : 1},${k}`);
    const csv = ['k,t,input.sl,truth.x', ...rows].join('\n');
    await page.getByLabel('Upload a CSV file').setInputFiles({ name: 'walk.csv', mimeType: 'text/csv', buffer: Buffer.from(csv) });
    await page.getByRole('cell', { name: 'walk', exact: true }).waitFor();
    await view.goto('/scenarios/consensus');
    await page.getByRole('combobox', { name: 'Input' }).locator('option', { hasText: 'walk' }).waitFor({ state: 'attached' });
    await view.close();
  });
});
