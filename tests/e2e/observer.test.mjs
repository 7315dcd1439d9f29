// The observer family's panels: errors, attacks and faults, methods with their words, the network, the design; runs that wait for gains.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { button, csvOf, openRange, query } from './support/live.mjs';
import { ring } from './support/ring.mjs';
import { counted, labelled, number, said } from './support/said.mjs';
import { call, finishedRun, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { everyTick, panel } from './support/sparse.mjs';

const word = (lane) => lane.replaceAll('_', ' ');
const metricOf = (run, lane, node, name) => run.metrics.find((metric) => metric.lane === lane && metric.node === node && metric.name === name)?.value ?? null;
/** As the page writes it: three significant digits. */
const near = (text, value) => assert.ok(Math.abs(Number(text) - value) <= 0.006 * Math.abs(value) + 1e-12, `${text} for ${value}`);
const rowsOf = (place) => place.locator('tbody tr').evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));

/** The panel's data as the page's own table, filled. */
async function tableOf(page, title) {
  const place = panel(page, title);
  await place.getByRole('button', { name: `${title}: Data as a table` }).click();
  const rows = await until(`the table of ${title} is filled`, async () => {
    const all = await rowsOf(place);
    return all.length === 100 && all.every((cells) => cells.every((cell) => cell !== '')) && all;
  });
  await place.getByRole('button', { name: `${title}: Data as a table` }).click();
  return rows;
}

describe('the observer family', () => {
  let server;
  let browser;
  let pair;
  const areas = {};
  const short = (steps, more = {}) => ({ time: { steps }, metrics: { window: { from: 1 } }, ...more });
  withSite(async (site) => {
    ({ server, browser } = site);
    pair = await finishedRun(server, { scenario: 'observer-pair', patch: { time: { steps: 3000 }, metrics: { window: { from: 2001 } } } });
    areas.fails = await finishedRun(server, { scenario: 'observer-areas', patch: short(3000, { plant: { params: { case: 2 } }, adversary: { area2: { enabled: true } } }) });
    areas.broken = await finishedRun(server, { scenario: 'observer-areas', patch: short(3000, { plant: { params: { case: 2 } } }) });
    areas.matched = await finishedRun(server, { scenario: 'observer-areas', patch: short(3000) });
  });

  async function open(run, more = '', options = {}) {
    const view = await openRange(browser, server, run.id, run.progress.k, more, options);
    await view.page.locator('.state-errors canvas').first().waitFor();
    return view;
  }

  test('state errors are estimate minus truth, as the log has them', async () => {
    const view = await open(pair, '&lane=intermediate_ref');
    const own = ['x1_1', 'x1_2', 'x1_3', 'x1_4', 'x2_1', 'x2_2', 'x2_3'];
    const names = own.flatMap((name) => [`lane.intermediate_ref.${name[1]}.estimate.${name}`, `truth.${name}`]);
    const { of } = await everyTick(server, pair.id, names, 3000);
    for (const [k, ...cells] of await tableOf(view.page, 'State errors')) {
      own.forEach((name, i) => {
        const error = of[names[2 * i]][k] - of[names[2 * i + 1]][k];
        assert.ok(Math.abs(Number(cells[i]) - error) <= 1e-3 * Math.abs(error) + 2e-6, `k ${k}, ${name}: ${cells[i]} for ${error}`);
      });
    }
    await counted(panel(view.page, 'State errors').getByRole('application'), 2);
    await panel(view.page, 'State errors').getByRole('button', { name: '± log' }).click();
    await until('the address has the scale', () => query(view.page, 'scale') === 'symlog');
    await view.close();
  });

  test('attack and fault of a chosen subsystem: the truth, every lane, and the CSV of both', async () => {
    // As narrow as that every tick is a row of its own.
    const last = 900;
    const view = await openRange(browser, server, pair.id, last, '&lane=intermediate_fast');
    const { page } = view;
    const place = panel(page, 'Attack and fault');
    await place.getByRole('combobox', { name: 'subsystem' }).selectOption('2');
    await until('the address has the subsystem', () => query(page, 'node') === '2');
    await counted(place.getByRole('application'), 4);
    const lanes = pair.world.lanes.map(({ id }) => id);
    const names = [...lanes.map((lane) => `lane.${lane}.2.attack.w1`), 'actuator.2.w1.injected'];
    const { of } = await everyTick(server, pair.id, names, last);
    for (const [k, ...cells] of await tableOf(page, 'Attack and fault')) names.forEach((name, i) => near(cells[i], of[name][k]));
    await place.getByRole('button', { name: word(lanes[1]), exact: true }).click();
    await until('a lane is hidden, in the address too', () => query(page, 'hide') === lanes[1]);
    const [download] = await Promise.all([page.waitForEvent('download'), place.getByRole('button', { name: /as CSV/ }).click()]);
    const [head, ...rows] = await csvOf(download);
    assert.deepEqual(head.slice(2).toSorted(), [lanes[0], lanes[2]].flatMap((lane) => [`lane.${lane}.2.attack.w1`, `lane.${lane}.2.fault.f1`]).concat('actuator.2.w1.injected', 'fault.2.f1').toSorted());
    assert.equal(rows.length, last + 1);
    await view.close();
  });

  test('the methods’ figures are the run’s metrics', async () => {
    const view = await open(pair);
    const methods = panel(view.page, 'Methods compared');
    for (const [button, name, offset] of [['attack', 'rms_attack_error', 1], ['fault', 'rms_fault_error', 1], ['state', 'rms_state_error', 0]]) {
      await methods.getByRole('button', { name: button, exact: true }).click();
      const rows = await until(`the table has ${name}`, async () => {
        const all = await rowsOf(methods);
        return all.length === 3 + offset && all;
      });
      pair.world.lanes.forEach(({ id }, i) => {
        const [lane, ...cells] = rows[i + offset];
        assert.equal(lane, word(id));
        ['1', '2'].forEach((node, j) => near(cells[j], metricOf(pair, id, node, name)));
      });
    }
    await view.close();
  });

  test('the attack itself is as large as the log has it', async () => {
    const view = await open(areas.fails);
    const { of } = await everyTick(server, areas.fails.id, ['actuator.2.w1.injected'], 3000);
    const values = of['actuator.2.w1.injected'].slice(1);
    const rms = Math.sqrt(values.reduce((sum, v) => sum + v * v, 0) / values.length);
    const row = panel(view.page, 'Methods compared').getByRole('row', { name: /^the attack itself/ });
    await until('its size is known', async () => Math.abs(Number(await row.locator('td').nth(1).innerText()) - rms) < 0.006 * rms);
    await view.close();
  });

  test('of the printed gains the page says what this run shows: certified, and they miss the attacks', async () => {
    const view = await open(pair);
    const place = panel(view.page, 'Methods compared');
    const record = pair.design.intermediate_printed;
    assert.ok(record.holds && record.max_real_pole < 0);
    await place.getByText('The gains printed in the paper (intermediate printed) are stable').waitFor();
    near((await said(place.getByText('are stable, their slowest pole'), new RegExp(`pole at ${number},`)))[1], record.max_real_pole);
    const missed = place.getByText('They do not estimate the attacks all the same.');
    near((await said(missed, new RegExp(`subsystem 1: ${number} of an attack`)))[1], metricOf(pair, 'intermediate_printed', '1', 'rms_attack_error'));
    await place.getByText('the certificate bounds the error of the state').waitFor();
    await view.close();
  });

  for (const [name, condition, sentence] of [
    ['matched', 'holds in every subsystem', 'as in figure 5'],
    ['broken', 'holds in subsystems 1, 3 and is violated in 2, 4', 'Figure 7 shows such an observer failing. This run does not'],
    ['fails', 'holds in subsystems 1, 3 and is violated in 2, 4', 'Here matched uio fails, as figure 7 says: subsystem 2 is attacked'],
  ]) {
    test(`of figure 7 the page says what this run shows: ${name}`, async () => {
      const run = areas[name];
      const view = await open(run);
      const { page } = view;
      const place = panel(page, 'Methods compared');
      await place.getByText(condition).waitFor();
      await place.getByText(sentence).waitFor();
      near((await said(place.getByText(sentence), new RegExp(`subsystem 1: ${number} of an attack`)))[1], metricOf(run, 'matched_uio', '1', 'rms_attack_error'));
      const picture = panel(page, 'Subsystems').getByRole('img');
      const holding = run.design.matched_uio.matched.filter(Boolean).length;
      await until(`the condition holds in ${holding}`, async () => (await picture.getAttribute('aria-label')).split('matching condition holds').length - 1 === holding);
      assert.equal((await place.getByRole('link', { name: 'case 2 with area 2 attacked' }).getAttribute('href')).startsWith('/scenarios/observer-areas?patch='), true);
      await view.close();
    });
  }

  test('of figure 8 the page compares lanes of the same bounds', async () => {
    const single = await finishedRun(server, { scenario: 'observer-single', patch: { time: { steps: 4000 } } });
    const view = await open(single);
    const place = panel(view.page, 'Methods compared');
    for (const preset of ['fast', 'ref']) {
      const [mine, theirs] = [`intermediate_${preset}`, `classical_${preset}`].map((lane) => metricOf(single, lane, single.world.nodes[0].id, 'rms_attack_error'));
      const sentence = place.getByText(`the RMS error of intermediate ${preset} is`);
      await said(sentence, new RegExp(`${Math.round(100 * Math.abs(1 - mine / theirs))} % ${mine < theirs ? 'lower' : 'higher'}`));
    }
    await view.close();
  });

  test('the network says who is attacked at the cursor', async () => {
    const view = await open(areas.fails, '&k=1000');
    const picture = panel(view.page, 'Subsystems').getByRole('img');
    // w1 begins after 2 s, that of area 2 at once.
    await until('area 2 alone is attacked', async () => /subsystem 2[^.]*attacked at the cursor/.test(await picture.getAttribute('aria-label')) && !/subsystem 1 [^.]*attacked at the cursor/.test(await picture.getAttribute('aria-label')));
    await panel(view.page, 'Subsystems').getByRole('button', { name: '3', exact: true }).click();
    await until('the address has the subsystem', () => query(view.page, 'node') === '3');
    await view.close();
  });

  test('the design card has the record, its poles as a table, and the problem to take along', async () => {
    const view = await open(pair, '&lane=intermediate_fast');
    const { page } = view;
    const card = panel(page, 'Design');
    const record = pair.design.intermediate_fast;
    await card.getByText('The certificate holds').waitFor();
    near((await said(card.locator('dl div', { hasText: 'objective' }).locator('dd'), new RegExp(`^${number}`)))[1], record.objective);
    near((await said(card.locator('dl div', { hasText: 'slowest pole' }).locator('dd'), new RegExp(`^${number}`)))[1], record.max_real_pole);
    await card.getByText(`Margins of ${record.margins.length} blocks`).click();
    assert.equal((await rowsOf(card)).length, record.margins.length);
    const address = await card.getByRole('link', { name: 'The problem in SDPA format' }).getAttribute('href');
    const text = await (await fetch(server.url + address)).text();
    assert.match(text, /^[\s\S]*\d+/);
    assert.ok(text.split('\n').length > 100);
    await card.getByRole('button', { name: 'Design: Data as a table' }).click();
    assert.equal((await rowsOf(card)).length, record.poles.length);
    await view.close();
  });

  test('a run that waits for its gains says so, on its page and in the list, and comes alive by itself', async () => {
    // One problem is solved at a time: these are ahead of the run's.
    const list = await openPage(browser, server);
    await list.goto('/runs');
    await list.page.locator('tr[data-run]').first().waitFor();
    const view = await openPage(browser, server);
    await call(server, 'POST', '/designs', { scenario: ring(4) });
    const { id } = await call(server, 'POST', '/runs', { scenario: 'observer-pair', pace: 1000, patch: { time: { steps: 2000 }, lanes: { intermediate_fast: { params: { cnu: 2e-9 } }, intermediate_ref: null } } });
    await view.goto(`/live/${id}`);
    await view.page.getByText('Gains are being computed').waitFor();
    await view.page.locator('[data-design=intermediate_fast]').getByText(/waiting|solving/).waitFor();
    await list.page.locator(`tr[data-run="${id}"]`).getByText('computing gains').waitFor();
    await view.page.locator('.state-errors canvas').first().waitFor();
    assert.equal((await runUntil(server, id, 'finished')).progress.k, 2000);
    await list.page.locator(`tr[data-run="${id}"]`).getByText('finished').waitFor();
    await list.close();
    await view.close();
  });

  test('eight subsystems have room: every chart, every box, no panel that scrolls the page', async () => {
    const run = await finishedRun(server, { scenario: ring(1) });
    const view = await open(run);
    const { page } = view;
    await counted(panel(page, 'State errors').getByRole('application'), 8);
    const picture = panel(page, 'Subsystems').getByRole('img');
    await until('every box is drawn', async () => (await picture.getAttribute('aria-label')).split('driven by').length - 1 === 8);
    await labelled(picture, /subsystem 1 with 4 states, 3 outputs, 1 attack and 1 fault channels; driven by 2, 8/);
    await page.locator('.design dl').first().waitFor();
    await view.close();
  });

  test('an attack on an actuator by hand is offered where a subsystem has one', async () => {
    const { id } = await call(server, 'POST', '/runs', { scenario: 'observer-pair', pace: 1000, patch: { time: { steps: null } } });
    await runUntil(server, id, 'running');
    const view = await openPage(browser, server);
    await view.goto(`/live/${id}`);
    await button(view.page, 'Attack an actuator').click();
    const dialog = view.page.getByRole('dialog', { name: 'Attack an actuator' });
    await until('a bias is offered', async () => (await dialog.getByRole('combobox', { name: 'Attack' }).inputValue()) === 'bias');
    await view.page.keyboard.press('Escape');
    await view.close();
    await call(server, 'DELETE', `/runs/${id}`);
  });

  for (const [theme, lang, width] of [['light', 'en', 1440], ['dark', 'zh', 1024], ['light', 'zh', 390]]) {
    test(`nothing for axe to say: ${theme}, ${lang}, ${width} px`, async () => {
      const view = await open(areas.fails, '&lane=matched_uio&k=1000&node=2', { theme, lang, width });
      await view.page.locator('.methods td').first().waitFor();
      await view.page.locator('.design dl').first().waitFor();
      await checkAxe(view.page, `the observer panels, ${theme} ${lang} ${width}`);
      await view.close();
    });
  }
});
