// Campaigns: started from a scenario, watched, paused and ended, read, and taken apart into single trials.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage, refused } from './support/browser.mjs';
import { button } from './support/live.mjs';
import { said } from './support/said.mjs';
import { call, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

const few = { time: { steps: 8 }, lanes: { naive_hold: null, naive_zero: null, centralized: null, isolated: null } };
const pdos = 'adversary.links.params.pdos';
const tau = 'lanes.consensus.params.tau';

describe('campaigns', () => {
  let server;
  let browser;
  let grid;
  let replay;

  const ended = (id) => until(`campaign ${id} is over`, async () => (await call(server, 'GET', `/campaigns/${id}`)).state === 'finished');
  const start = async (body) => (await call(server, 'POST', '/campaigns', { threads: 1, ...body })).id;

  withSite(async (site) => {
    ({ server, browser } = site);
    grid = await start({ scenario: 'consensus', patch: few, runs: 6, first_seed: 3, sweep: { [pdos]: [0, 0.4, 0.8], [tau]: [0.01, 0.02] } });
    replay = await start({ scenario: 'replay-ubb', runs: 3 });
    await ended(grid);
    await ended(replay);
  });

  const figure = (page, name) => page.locator('section', { has: page.getByRole('heading', { name, exact: true }) });
  const saved = async (page, name) => {
    const waiting = page.waitForEvent('download');
    await button(page, name).click();
    return readFileSync(await (await waiting).path());
  };
  /** As the page writes it. */
  const near = (text, value) => assert.ok(Math.abs(Number(text) - value) <= 0.006 * Math.abs(value) + 1e-12, `${text} for ${value}`);

  test('starts from a scenario with what was changed there, and shows what comes out', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/scenarios/consensus?patch=${encodeURIComponent(JSON.stringify(few))}`);
    await button(page, 'Campaign…').click();
    await page.getByRole('heading', { name: 'New campaign' }).waitFor();
    await page.getByRole('textbox', { name: 'Runs per point' }).fill('4');
    await page.getByLabel('Path 1').fill('adversary.links.params.nothing');
    await page.getByLabel('Values 1').fill('0, 0.5');
    await page.getByText('The scenario has no member adversary.links.params.nothing.').waitFor();
    await page.getByLabel('Path 1').fill(pdos);
    await said(page.getByRole('form', { name: 'New campaign' }).getByRole('status'), /2 points, 8 trials/);
    await button(page, 'Start the campaign').click();
    const id = await until('the campaign has its page', async () => /\/campaigns\/(\d+)$/.exec(new URL(page.url()).pathname)?.[1]);
    await page.getByText('8 of 8 trials').waitFor();
    const answer = await call(server, 'GET', `/campaigns/${id}`);
    assert.equal(answer.document.time.steps, 8, 'the changes came along');
    const one = answer.metrics.find((metric) => metric.lane === 'consensus' && metric.node === null && metric.name === 'rmse_position' && metric.cell === 1);
    const shown = await said(page.getByRole('region', { name: /^Results/ }).locator('tbody tr').nth(1).locator('td').nth(2), /^([\d.e-]+) ± ([\d.e-]+)\s+([\d.e-]+) \[/);
    near(shown[1], one.mean);
    near(shown[3], one.median);
    await page.getByRole('link', { name: 'All campaigns' }).click();
    await page.getByRole('link', { name: `Campaign ${id}` }).waitFor();
    await view.close();
  });

  test('lists the farthest trials first and runs one alone, to the same values', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/campaigns/${grid}?cell=4&metric=rmse_position`);
    const first = (await call(server, 'GET', `/campaigns/${grid}/trials?cell=4&metric=consensus.rmse_position&sort=outlier&limit=1`)).items[0];
    const row = figure(page, 'Single trials').locator('tbody tr').first();
    await said(row, new RegExp(`^${first.index}\\s+${first.seed}\\s`));
    await row.getByRole('button', { name: `Run trial ${first.index} alone` }).click();
    const run = await until('the run has its page', async () => /\/live\/(\d+)$/.exec(new URL(page.url()).pathname)?.[1]);
    const { metrics, seed } = await runUntil(server, run, 'finished');
    assert.equal(seed, first.seed);
    assert.equal(metrics.find((one) => one.lane === 'consensus' && one.node === null && one.name === 'rmse_position').value, first.value);
    await view.close();
  });

  test('keeps the point, metric and lanes in the address, and chooses a point in the table and in the surface', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/campaigns/${grid}`);
    await button(page, 'Point 3').click();
    await page.getByLabel('Metric').selectOption('rmse_heading');
    await page.getByRole('checkbox', { name: 'drop' }).uncheck();
    const query = new URL(page.url()).searchParams;
    assert.deepEqual([query.get('cell'), query.get('metric'), query.get('hide')], ['3', 'rmse_heading', 'drop']);
    await page.reload();
    await page.getByRole('img', { name: /^rmse_heading over adversary\.links\.params\.pdos: means of 2 lanes/ }).waitFor();
    const surface = page.getByRole('img', { name: /^rmse_heading of consensus over/ });
    const box = await surface.boundingBox();
    await surface.click({ position: { x: box.width - 80, y: 20 } });
    await until('the last point is chosen', async () => new URL(page.url()).searchParams.get('cell') === '5');
    assert.equal(await button(page, 'Point 5').getAttribute('aria-pressed'), 'true');
    await view.close();
  });

  test('shows differences with intervals and detection curves as the API has them', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/campaigns/${replay}`);
    const { result } = await call(server, 'GET', `/campaigns/${replay}/cells/0`);
    const detection = result.detection.find((one) => one.lane === 'innov' && one.node === null);
    const cells = figure(page, 'Detection curves').getByRole('row', { name: /^innov\s/ }).getByRole('cell');
    near((await said(cells.nth(0), /([\d.e-]+)/))[1], detection.by_factor.area);
    near((await said(cells.nth(1), /([\d.e-]+)/))[1], detection.own.fpr);
    const pair = result.paired.find((one) => one.base === 'as_written' && one.lane === 'eq29' && one.name === 'rmse_norm' && one.node === null && one.variant === null);
    const interval = await said(figure(page, 'Paired differences').getByRole('row', { name: /^eq29\s/ }), /\[(-?[\d.e-]+), (-?[\d.e-]+)\]/);
    near(interval[1], pair.lo);
    near(interval[2], pair.hi);
    await figure(page, 'Paired differences').getByLabel('Base').selectOption('eq29');
    const turned = await said(figure(page, 'Paired differences').getByRole('row', { name: /^as_written\s/ }), /\[(-?[\d.e-]+), (-?[\d.e-]+)\]/);
    near(turned[1], -pair.hi);
    await view.close();
  });

  test('gives CSV, SVG and PNG', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/campaigns/${grid}?metric=rmse_position`);
    await page.getByRole('img', { name: /^rmse_position over/ }).waitFor();
    assert.match((await saved(page, 'CSV of all figures')).toString(), new RegExp(`^cell,${pdos},${tau},lane,`));
    const lines = (await saved(page, 'CSV of Means and quantiles')).toString().trim().split('\n');
    assert.equal(lines.length, 1 + 3 * 3, 'three values by three lanes');
    const svg = (await saved(page, 'SVG of Means and quantiles')).toString();
    assert.match(svg, /^<svg [^]*<\/svg>\s*$/);
    assert.ok(!/NaN|undefined/.test(svg), 'only numbers stand in it');
    const wrong = await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').querySelector('parsererror')?.textContent ?? '', svg);
    assert.equal(wrong, '');
    assert.deepEqual([...(await saved(page, 'PNG of Surface')).subarray(1, 4)], [...Buffer.from('PNG')]);
    await view.close();
  });

  test('draws every trial over parameters and metrics', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/campaigns/${grid}?metric=rmse_position`);
    await button(page, 'Read the trials').click();
    await page.getByRole('img', { name: '36 trials over 5 axes' }).waitFor();
    await page.getByLabel('Further axis').selectOption('consensus.rmse_heading');
    await page.getByRole('img', { name: '36 trials over 6 axes' }).waitFor();
    const rows = await until('the lines have the further axis', async () => {
      const lines = (await saved(page, 'CSV of Parallel coordinates')).toString().trim().split('\n');
      return lines[0].endsWith('consensus.rmse_heading') && lines;
    });
    assert.equal(rows.length, 37);
    const trials = (await call(server, 'GET', `/campaigns/${grid}/trials?cell=0&metric=consensus.rmse_heading&limit=6`)).items;
    assert.deepEqual(rows.slice(1, 7).map((line) => Number(line.split(',').at(-1))), trials.map((one) => one.value));
    await view.close();
  });

  test('chooses trials by a stroke along an axis and by numbers, and runs one of them', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/campaigns/${grid}?metric=rmse_position`);
    await button(page, 'Read the trials').click();
    const plot = page.getByRole('img', { name: '36 trials over 5 axes' });
    await plot.scrollIntoViewIfNeeded();
    const part = figure(page, 'Parallel coordinates');
    await part.getByText('Limits as numbers').click();
    await part.getByLabel(`${pdos}: from`).fill('0.3');
    await part.getByLabel(`${pdos}: from`).press('Enter');
    await part.getByText('24 of 36 trials chosen').waitFor();
    const lines = (await saved(page, 'CSV of Parallel coordinates')).toString().trim().split('\n').slice(1);
    assert.equal(lines.length, 24);
    assert.ok(lines.every((line) => Number(line.split(',')[3]) > 0.3));
    const box = await plot.boundingBox();
    const axis = box.x + 14 + (box.width - 28) / 4;
    await page.mouse.move(axis, box.y + 36);
    await page.mouse.down();
    await page.mouse.move(axis + 2, box.y + 100, { steps: 4 });
    await page.mouse.up();
    await part.getByText('12 of 36 trials chosen').waitFor();
    assert.equal(await part.getByLabel(`${tau}: to`).inputValue(), '0.02');
    await part.getByRole('checkbox', { name: 'Only these' }).check();
    const svg = (await saved(page, 'SVG of Parallel coordinates')).toString();
    assert.equal(svg.match(/<path d="M/g).length, 12 + 5, 'a path a chosen trial and an axis');
    await plot.focus();
    await page.keyboard.press('End');
    const spoken = await said(part.locator('.holder [role=status]'), /^Trial (\d+): /);
    await page.keyboard.press('Enter');
    const run = await until('the run has its page', async () => /\/live\/(\d+)$/.exec(new URL(page.url()).pathname)?.[1]);
    const trial = await call(server, 'GET', `/campaigns/${grid}/trials/${spoken[1]}`);
    assert.deepEqual((await runUntil(server, run, 'finished')).metrics, trial.metrics);
    await view.close();
  });

  test('says the values under the pointer and by the keyboard, and zooms', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/campaigns/${grid}?metric=rmse_position`);
    const { metrics } = await call(server, 'GET', `/campaigns/${grid}`);
    const part = figure(page, 'Means and quantiles');
    const plot = part.getByRole('img');
    await plot.scrollIntoViewIfNeeded();
    await plot.focus();
    await page.keyboard.press('Home');
    const first = await said(part.locator('.holder [role=status]'), /^(\w+), 0: ([\d.e-]+) ± ([\d.e-]+); ([\d.e-]+) \[/);
    const one = metrics.find((metric) => metric.lane === first[1] && metric.node === null && metric.name === 'rmse_position' && metric.cell === 0);
    near(first[2], one.mean);
    near(first[4], one.median);
    const hits = async () => {
      await page.keyboard.press('Home');
      const from = await part.locator('.holder [role=status]').innerText();
      await page.keyboard.press('End');
      return [from, await part.locator('.holder [role=status]').innerText()];
    };
    const before = await hits();
    await page.keyboard.press('+');
    await button(page, 'Whole picture of Means and quantiles').waitFor();
    await until('the first point is out of the picture', async () => (await hits())[0] !== before[0]);
    await page.keyboard.press('0');
    await until('the whole picture is back', async () => JSON.stringify(await hits()) === JSON.stringify(before));
    const box = await plot.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + 60);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width - 12, box.y + 250, { steps: 4 });
    await page.mouse.up();
    await button(page, 'Whole picture of Means and quantiles').click();
    await button(page, 'Whole picture of Means and quantiles').waitFor({ state: 'detached' });
    const surface = figure(page, 'Surface');
    const place = await surface.getByRole('img').boundingBox();
    await page.mouse.move(place.x + place.width - 80, place.y + 20);
    const tip = await said(surface.locator('.tip'), /^0\.8, 0\.02: ([\d.e-]+) ± /);
    near(tip[1], metrics.find((metric) => metric.lane === 'consensus' && metric.node === null && metric.name === 'rmse_position' && metric.cell === 5).mean);
    await view.close();
  });

  test('edits tags and note', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/campaigns/${replay}`);
    await button(page, 'Add tags or a note').click();
    await page.getByLabel('Tags, apart by commas').fill('paper, second try');
    await page.getByRole('dialog').getByLabel('Note').fill('What for?');
    await button(page, 'Save').click();
    await page.getByText('second try').waitFor();
    const { tags, note } = await call(server, 'GET', `/campaigns/${replay}`);
    assert.deepEqual([tags, note], [['paper', 'second try'], 'What for?']);
    await view.close();
  });

  test('gives every figure as CSV, SVG and PNG', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    for (const [id, names] of [[grid, ['Means and quantiles', 'Surface', 'Single trials', 'Paired differences', 'Parallel coordinates']], [replay, ['Detection curves']]]) {
      await view.goto(`/campaigns/${id}`);
      if (id === grid) await button(page, 'Read the trials').click();
      for (const name of names) {
        await figure(page, name).getByRole('img').waitFor();
        assert.ok((await saved(page, `CSV of ${name}`)).toString().trim().split('\n').length > 1, name);
        const svg = (await saved(page, `SVG of ${name}`)).toString();
        assert.match(svg, /^<svg [^]*<\/svg>\s*$/, name);
        assert.ok(!/NaN|undefined|Infinity/.test(svg), `${name}: only numbers stand in it`);
        assert.deepEqual([...(await saved(page, `PNG of ${name}`)).subarray(1, 4)], [...Buffer.from('PNG')], name);
      }
    }
    await view.close();
  });

  test('pauses, goes on, cancels and deletes', async () => {
    const id = await start({ scenario: 'consensus', runs: 100_000 });
    const view = await openPage(browser, server, { allowed: [refused(404)] });
    const { page } = view;
    await view.goto(`/campaigns/${id}`);
    await page.getByText(/trials\/s/).waitFor();
    await page.getByText(/ left$/).waitFor();
    await button(page, 'Pause').click();
    await button(page, 'Go on').waitFor();
    assert.equal((await call(server, 'GET', `/campaigns/${id}`)).state, 'paused');
    await button(page, 'Go on').click();
    await page.getByText(/trials\/s/).waitFor();
    await button(page, 'Cancel').click();
    await page.getByText('cancelled', { exact: true }).waitFor();
    await button(page, 'Delete').click();
    const dialog = page.getByRole('dialog');
    await dialog.getByText('Its ').waitFor();
    await dialog.getByRole('button', { name: 'Delete', exact: true }).click();
    await until('the list is shown', async () => new URL(page.url()).pathname === '/campaigns');
    await view.goto(`/campaigns/${id}`);
    await page.getByText(`There is no campaign ${id}.`).waitFor();
    await view.close();
  });

  test('keeps a grid of 200 points out of the page’s way', async () => {
    const id = await start({ scenario: 'consensus', patch: { ...few, time: { steps: 2 } }, runs: 2, sweep: { [pdos]: Array.from({ length: 20 }, (_, i) => i / 25), [tau]: Array.from({ length: 10 }, (_, i) => 0.005 + i / 1000) } });
    await ended(id);
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/campaigns/${id}`);
    await page.getByText('points 1 to 40 of 200').waitFor();
    const table = page.getByRole('region', { name: /^Results/ });
    assert.equal(await table.locator('tbody tr').count(), 40);
    await button(page, 'After').click();
    await page.getByText('points 41 to 80 of 200').waitFor();
    await button(page, 'Point 79').click();
    await page.getByRole('img', { name: /^rmse_position of consensus over/ }).waitFor();
    const elements = await page.locator('*').count();
    assert.ok(elements < 3000, `${elements} elements`);
    await view.close();
  });

  for (const [lang, theme, width] of [['en', 'light', 1440], ['zh', 'dark', 1024], ['en', 'dark', 390], ['zh', 'light', 390]]) {
    test(`has no barrier: ${lang}, ${theme}, ${width} px`, async () => {
      const view = await openPage(browser, server, { lang, theme, width });
      const { page } = view;
      for (const path of ['/campaigns?scenario=consensus', `/campaigns/${grid}`, `/campaigns/${replay}`]) {
        await view.goto(path);
        await page.locator(path.includes('?') ? 'form select option:nth-child(2)' : 'section table tbody tr button').first().waitFor({ state: 'attached' });
        await checkAxe(page, `${path} ${lang} ${theme} ${width}`);
        const wide = await page.locator('main').evaluate((main) => main.scrollWidth - main.clientWidth);
        assert.ok(wide <= 0, `${path}: nothing is wider than the page: ${wide} px`);
      }
      await view.close();
    });
  }
});
