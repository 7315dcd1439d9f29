// The sparse family's panels of where things are and how far off: trajectories in space, errors per node, Table 2.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { button, cursorOf, openRange, query, tickPast } from './support/live.mjs';
import { counted } from './support/said.mjs';
import { call, finishedRun, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { everyTick, panel, stations } from './support/sparse.mjs';

const last = 200;
const space = (page) => panel(page, 'Trajectories');
const view3 = (page) => space(page).getByRole('application');

/** The canvas as a text: another picture is another text. */
const picture = (page) => view3(page).locator('canvas').evaluate((canvas) => canvas.toDataURL());
const repainted = (page, before) => until('the picture is another one', async () => (await picture(page)) !== before);

async function cellsOf(rows) {
  return rows.evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => ({ text: cell.textContent.trim(), weight: Number(getComputedStyle(cell).fontWeight) }))));
}

describe('trajectories, errors and Table 2', () => {
  let server;
  let browser;
  let run;
  withSite(async (site) => {
    ({ server, browser } = site);
    run = await finishedRun(server, { scenario: 'sparse', seed: 3 });
  });

  async function open(more = '', options = {}) {
    const view = await openRange(browser, server, run.id, last, more, options);
    await view3(view.page).locator('canvas').waitFor();
    // Nothing is drawn until the samples are there.
    const blank = await view3(view.page).locator('canvas').evaluate((canvas) => Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height }).toDataURL());
    await repainted(view.page, blank);
    return view;
  }

  test('the space is turned by hand and by keys, and turned back', async () => {
    const view = await open();
    const { page } = view;
    const at = view3(page);
    const turn = () => at.getAttribute('data-turn');
    assert.equal(await turn(), '-60,34');
    const usual = await picture(page);
    const box = await at.boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 40, y + 20, { steps: 4 });
    await until('it follows the hand', async () => (await turn()) === '-80,44');
    assert.equal(query(page, 'turn'), null, 'the address waits for the hand to let go');
    await page.mouse.up();
    await until('the address has it', () => query(page, 'turn') === '-80,44');
    await repainted(page, usual);
    await at.focus();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('Shift+ArrowDown');
    await until('keys turn it too', async () => (await turn()) === '-75,29');
    assert.equal(cursorOf(page), null, 'and move no cursor');
    await at.dblclick();
    await until('a double click turns it back', async () => (await turn()) === '-60,34' && query(page, 'turn') === null);
    await view.close();
  });

  test('the planes are other sights of the same, and there the arrows are the cursor’s again', async () => {
    const view = await open();
    const { page } = view;
    let before = await picture(page);
    for (const [word, see] of [['x–y', 'xy'], ['x–z', 'xz'], ['y–z', 'yz']]) {
      await space(page).getByRole('button', { name: word, exact: true }).click();
      await until('the address has it', () => query(page, 'see') === see);
      await repainted(page, before);
      before = await picture(page);
    }
    await view3(page).focus();
    await page.keyboard.press('ArrowLeft');
    await until('the cursor moves', () => Number(cursorOf(page)) === last - 1);
    await space(page).getByRole('combobox', { name: 'Lane' }).selectOption('dkf');
    await repainted(page, before);
    await view.close();
  });

  test('who is attacked at the cursor stands at the nodes, with the letter of the type', async () => {
    const view = await open('&k=100');
    const { page } = view;
    const keys = () => space(page).getByRole('group', { name: 'Nodes' }).getByRole('button').evaluateAll((list) => list.map((one) => one.textContent.replace(/\s+/g, ' ').trim()));
    await until('nodes 2 and 4', async () => (await keys()).join() === '1,2 I,3,4 II,5');
    await view3(page).and(page.getByRole('application', { name: /Attacked sensors: 2, 4\.$/ })).waitFor();
    await page.goto(page.url().replace('k=100', 'k=190'));
    await until('the majority', async () => (await keys()).join() === '1 I,2,3 II,4,5 I');
    await view.close();
  });

  test('errors per node are estimate minus truth, pred beside them', async () => {
    const view = await open('&lane=l1');
    const { page } = view;
    const { of } = await everyTick(server, run.id, ['truth.px', 'truth.vx', 'lane.pred.1.estimate.px', ...stations.flatMap((id) => [`lane.l1.${id}.estimate.px`, `lane.l1.${id}.estimate.vx`])], last);
    const errors = panel(page, 'Errors per node');
    await counted(errors.getByRole('application'), 2);
    await errors.getByRole('button', { name: 'linear', exact: true }).click();
    await until('the address has the scale', () => query(page, 'scale') === 'linear');
    await errors.getByRole('button', { name: 'Errors per node: Data as a table' }).click();
    const rows = await until('the table is filled', async () => {
      const all = await errors.locator('tbody tr').evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
      return all.length > 90 && all[0].every((cell) => cell !== '' && cell !== '–') && all;
    });
    const head = await errors.locator('thead th').allInnerTexts();
    assert.deepEqual(head, ['k', 'px pred', ...stations.map((id) => `px ${id}`), 'vx pred', ...stations.map((id) => `vx ${id}`)]);
    for (const row of rows.slice(0, 40)) {
      const k = Number(row[0]);
      const wanted = (lane, id, component) => of[`lane.${lane}.${id}.estimate.${component}`][k] - of[`truth.${component}`][k];
      const near = (column, value) => assert.ok(Math.abs(Number(row[head.indexOf(column)]) - value) <= 1e-3 * Math.abs(value) + 1e-5, `k ${k}, ${column}: ${row[head.indexOf(column)]} for ${value}`);
      near('px pred', wanted('pred', 1, 'px'));
      for (const id of stations) {
        near(`px ${id}`, wanted('l1', id, 'px'));
        near(`vx ${id}`, wanted('l1', id, 'vx'));
      }
    }
    await view.close();
  });

  test('Table 2 has nine lanes with pred below, marks the least, and keeps the source’s figures apart', async () => {
    const view = await open();
    const { page } = view;
    const at = panel(page, 'Table 2, live');
    const value = (lane, node, name) => run.metrics.find((metric) => metric.lane === lane && String(metric.node) === node && metric.name === name).value;
    const lanes = ['omp_game', 'l1', 'dkf', 'etpg', 'sdlms', 'omp', 'ekf', 'omp_game_channels', 'pred'];
    for (const [word, name] of [['whole run', 'mse_px'], ['0–9 s', 'mse_px_0_9s']]) {
      await at.getByRole('button', { name: word, exact: true }).click();
      const rows = await cellsOf(at.locator('tbody').first().locator('tr'));
      assert.equal(rows.length, lanes.length);
      stations.forEach((node, column) => {
        const least = Math.min(...lanes.map((lane) => value(lane, node, name)));
        lanes.forEach((lane, i) => {
          const [head, cell] = [rows[i][0].text, rows[i][column + 1]];
          assert.ok(head.startsWith(lane.replaceAll('_', ' ')), head);
          assert.ok(Math.abs(Number(cell.text) - value(lane, node, name)) <= 0.006 * value(lane, node, name), `${lane} ${node}: ${cell.text}`);
          assert.equal(cell.weight >= 600, value(lane, node, name) === least, `${lane} ${node}`);
        });
      });
      assert.equal(await at.getByText('40.6553').count(), name === 'mse_px' ? 1 : 0);
    }
    await at.getByRole('button', { name: 'whole run', exact: true }).click();
    await at.getByText('printed in the source', { exact: true }).waitFor();
    await at.getByText('A whole-run mean alone proves nothing').waitFor();
    await at.getByRole('button', { name: 'Copy as CSV' }).click();
    const lines = await until('the clipboard has the table', async () => {
      const text = await page.evaluate(() => navigator.clipboard.readText());
      return text.includes('node 5') && text.trim().split('\n');
    });
    assert.equal(lines.length, 1 + lanes.length + 5);
    assert.equal(Number(lines[1].split(',')[3]), value('omp_game', '1', 'mse_px'));
    await at.getByRole('button', { name: /^dkf/ }).click();
    await until('the lane is chosen', () => query(page, 'lane') === 'dkf');
    await view.close();
  });

  test('a run that goes on draws on and fills the table', async () => {
    const live = await call(server, 'POST', '/runs', { scenario: 'sparse', seed: 4, pace: 20, patch: { time: { steps: null } } });
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/live/${live.id}`);
    const k = await tickPast(page, 10);
    const before = await picture(page);
    await tickPast(page, k + 5);
    await repainted(page, before);
    await until('pred has a figure', async () => Number(await panel(page, 'Table 2, live').getByRole('row', { name: /^pred/ }).locator('td').first().innerText()) > 0);
    await button(page, 'Pause the run').click();
    await button(page, 'Resume the run').waitFor();
    await view.close();
    await call(server, 'DELETE', `/runs/${live.id}`);
  });

  for (const [theme, lang, width] of [['light', 'en', 1440], ['dark', 'zh', 390]]) {
    test(`nothing for axe to say: ${theme}, ${lang}, ${width} px`, async () => {
      const view = await openPage(browser, server, { theme, lang, width });
      await view.goto(`/live/${run.id}?k=150`);
      await view.page.locator('.space canvas').waitFor();
      await view.page.locator('.table2 td').first().waitFor();
      await checkAxe(view.page, `the sparse panels, ${theme} ${lang} ${width}`);
      await view.close();
    });
  }
});
