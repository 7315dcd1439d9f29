// Attacking by hand on the drawing, the delay until lanes notice, moving an attack in time, thresholds in flight.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { button, openLive, openRange, tickPast } from './support/live.mjs';
import { call, finishedRun, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

describe('live hands', () => {
  let server;
  let browser;
  withSite((site) => ({ server, browser } = site));

  const marksOf = async (run, type) => (await call(server, 'GET', `/runs/${run.id}/marks?type=${type}&limit=5000`)).items;
  const attackEdge = (run, edge, code) => until(`the attack ${edge}s`, async () => (await marksOf(run, 'attack')).find((mark) => mark.edge === edge && mark.code === code));
  const taken = (page) => page.getByRole('listbox', { name: /^Links, sensors/ });
  const item = (page, name) => page.getByRole('menuitem', { name, exact: true });
  const textOf = async (locator) => ((await locator.count()) ? (await locator.first().textContent()) : '');

  /** Walks by keys to what is called so; answers the middle of its drawing, in the window. */
  async function walkTo(page, target) {
    const box = taken(page);
    await box.focus();
    const ids = await box.locator('[role=option]').evaluateAll((options) => options.map((option) => option.dataset.target));
    assert.ok(ids.includes(target), `${target} is among ${ids.join(' ')}`);
    await box.press('Home');
    for (let i = 0; i < ids.indexOf(target); i += 1) await box.press('ArrowRight');
    await until(`${target} is chosen`, async () => (await box.locator('[aria-selected=true]').getAttribute('data-target')) === target);
    const drawn = await box.locator('svg > *').first().boundingBox();
    return { x: drawn.x + drawn.width / 2, y: drawn.y + drawn.height / 2 };
  }

  test('jams a link by a click on it, shows it jammed, and stops it from the same menu by keys', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await openLive(view, server, call, { patch: { time: { steps: null }, adversary: { links: null } } });
    const { x, y } = await walkTo(page, 'link:2-3');
    await page.mouse.click(x, y);
    await item(page, 'Jam').waitFor();
    await checkAxe(page, 'the menu of a link');
    await item(page, 'Jam').click();
    const begin = await attackEdge(run, 'begin', 'dos');
    assert.equal(begin.link, '2-3');
    await until('the drawing says that it is jammed', async () => (await textOf(page.locator('[data-target="link:2-3"]'))) === 'Link 2→3, jammed');
    await until('so does the strip', async () => /dos · 2→3/.test(await textOf(page.getByRole('region', { name: 'Attacks by hand' }))));
    await walkTo(page, 'link:2-3');
    await taken(page).press('Enter');
    const stop = page.getByRole('menuitem', { name: `Stop ${begin.id}` });
    await stop.waitFor();
    await until('the first entry has the focus', () => stop.evaluate((one) => one === document.activeElement));
    await page.keyboard.press('Enter');
    await attackEdge(run, 'end', 'dos');
    await until('the drawing is untouched', async () => (await textOf(page.locator('[data-target="link:2-3"]'))) === 'Link 2→3, untouched');
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('opens the dialog with the place and sends when the attack acts', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await openLive(view, server, call, { patch: { time: { steps: null }, adversary: { links: null } } });
    await walkTo(page, 'link:4-5');
    await taken(page).press('Enter');
    await item(page, 'More…').click();
    const dialog = page.getByRole('dialog', { name: /^Attack/ });
    await until('the link is chosen', async () => (await dialog.getByRole('button', { name: '4→5', exact: true }).getAttribute('aria-pressed')) === 'true');
    await dialog.getByRole('combobox', { name: 'Attack' }).selectOption('dos');
    await dialog.getByRole('checkbox', { name: 'in bursts' }).check();
    await dialog.getByRole('spinbutton', { name: 'Every' }).fill('6');
    await dialog.getByRole('spinbutton', { name: 'for', exact: true }).fill('2');
    await dialog.getByRole('checkbox', { name: 'no limit' }).uncheck();
    await dialog.getByRole('spinbutton', { name: 'ticks in all, at most' }).fill('4');
    await checkAxe(page, 'the dialog of an attack');
    await dialog.getByRole('button', { name: 'Start the attack' }).click();
    const marks = await until('it acted twice', async () => {
      const found = (await marksOf(run, 'attack')).map((mark) => mark.k);
      return found.length === 4 ? found : null;
    });
    assert.deepEqual(marks.map((k) => k - marks[0]), [0, 2, 6, 8]);
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('tells after how many ticks each lane noticed a replay, who did not, and who cannot', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await call(server, 'POST', '/runs', { scenario: 'replay-mixed', seed: 3, pace: 1, patch: { adversary: { replay: null } } });
    await until('it is made', async () => (await call(server, 'GET', `/runs/${run.id}`)).progress.k >= 0);
    await call(server, 'PATCH', `/runs/${run.id}`, { state: 'paused' });
    const { progress } = await call(server, 'GET', `/runs/${run.id}`);
    await call(server, 'PATCH', `/runs/${run.id}`, { step: 109 - progress.k });
    await until('it stands at tick 109', async () => (await call(server, 'GET', `/runs/${run.id}`)).progress.k === 109);
    await view.goto(`/live/${run.id}`);
    await tickPast(page, 108);
    await walkTo(page, 'node:1');
    await taken(page).press('Enter');
    await item(page, 'Replay').click();
    await until('the run has the command', async () => (await call(server, 'GET', `/runs/${run.id}`)).commands.length === 1);
    await call(server, 'PATCH', `/runs/${run.id}`, { pace: 'max', state: 'running' });
    await until('it has ended', async () => (await call(server, 'GET', `/runs/${run.id}`)).state === 'finished');
    const begin = await attackEdge(run, 'begin', 'replay');
    assert.equal(begin.k, 110);
    const alarms = await marksOf(run, 'alarm');
    const first = (lane) => alarms.find((mark) => mark.lane === lane && mark.edge === 'begin' && mark.k >= begin.k);
    const said = (lane) => textOf(page.locator(`.attacks [data-attack="${begin.id}"] [data-lane="${lane}"]`));
    const words = (ticks) => (ticks === 0 ? 'noticed at once' : ticks === 1 ? 'noticed after 1 tick' : `noticed after ${ticks} ticks`);
    assert.ok(first('repaired'), 'the repaired detector notices');
    for (const lane of ['repaired', 'fixed_square']) {
      const ticks = first(lane).k - begin.k;
      await until(`${lane}: ${words(ticks)}`, async () => (await said(lane)).trim().endsWith(words(ticks)));
    }
    assert.equal(first('as_written'), undefined, 'its residual is zero');
    await until('as printed nothing is noticed', async () => /not yet|not noticed/.test(await said('as_written')));
    await until('a lane without a detector is named', async () => /without a detector: .*ufir/.test(await textOf(page.locator(`.attacks [data-attack="${begin.id}"]`))));
    await view.close();
  });

  describe('an attack of the past', () => {
    let origin;
    const steps = 40;
    const open = async () => {
      origin ??= await finishedRun(server, { scenario: 'consensus', seed: 2, patch: { time: { steps }, adversary: { links: null, burst: { type: 'dos', on: ['link:*'], from: 10, to: 14, params: {} } } } });
      const view = await openRange(browser, server, origin.id, steps);
      const bar = view.page.locator('[data-bar="burst"]');
      await bar.waitFor();
      return { view, page: view.page, bar };
    };
    const times = (bar) => bar.getAttribute('aria-valuetext');
    const forkOf = async (page) => {
      const id = await until('the fork is open', () => {
        const found = /\/live\/(\d+)/.exec(page.url())?.[1];
        return found && found !== origin.id ? found : null;
      });
      return call(server, 'GET', `/runs/${id}`);
    };

    test('is moved by keys into a fork', async () => {
      const { view, page, bar } = await open();
      await bar.focus();
      for (let i = 0; i < 5; i += 1) await bar.press('ArrowRight');
      for (let i = 0; i < 2; i += 1) await bar.press('Shift+ArrowRight');
      await until('it lies later and lasts longer', async () => (await times(bar)) === 'k = 15 to 21');
      await page.getByRole('button', { name: 'Fork with the attack at k = 15…21' }).waitFor();
      await checkAxe(page, 'the question about a moved attack');
      await bar.press('Escape');
      await until('it lies where it was', async () => (await times(bar)) === 'k = 10 to 14');
      await bar.press('ArrowLeft');
      await until('it lies a tick earlier', async () => (await times(bar)) === 'k = 9 to 13');
      await page.getByRole('button', { name: /^Fork with the attack/ }).waitFor();
      await bar.press('Enter');
      const fork = await forkOf(page);
      assert.deepEqual(fork.parent, { run: origin.id, k: 8 });
      const { from, to, type } = fork.document.adversary.burst;
      assert.deepEqual({ from, to, type }, { from: 9, to: 13, type: 'dos' });
      await view.close();
    });

    test('is dragged by its body and by an end', async () => {
      const { view, page, bar } = await open();
      const box = await bar.boundingBox();
      const middle = [box.x + box.width / 2, box.y + box.height / 2];
      await page.mouse.move(...middle);
      await page.mouse.down();
      await page.mouse.move(middle[0] + 4 * box.width, middle[1], { steps: 6 });
      await page.mouse.up();
      const later = await until('it lies later', async () => {
        const [, from, to] = /k = (\d+) to (\d+)/.exec(await times(bar)) ?? [];
        return Number(from) > 14 ? { from: Number(from), to: Number(to) } : null;
      });
      assert.equal(later.to - later.from, 4, 'it lasts as long');
      const moved = await bar.boundingBox();
      await page.mouse.move(moved.x + moved.width - 3, moved.y + moved.height / 2);
      await page.mouse.down();
      await page.mouse.move(moved.x + moved.width - 3 - moved.width / 2, moved.y + moved.height / 2, { steps: 4 });
      await page.mouse.up();
      const shorter = await until('it ends sooner', async () => {
        const [, from, to] = /k = (\d+) to (\d+)/.exec(await times(bar)) ?? [];
        return Number(to) < later.to ? { from: Number(from), to: Number(to) } : null;
      });
      assert.equal(shorter.from, later.from);
      await page.getByRole('button', { name: /^Fork with the attack/ }).click();
      const fork = await forkOf(page);
      assert.equal(fork.parent.k, 9);
      const { from, to } = fork.document.adversary.burst;
      assert.deepEqual({ from, to }, shorter);
      await view.close();
    });

    test('is given another time in numbers, too', async () => {
      const { view, page } = await open();
      await button(page, 'Move burst').click();
      const first = page.getByRole('spinbutton', { name: 'First tick' });
      await first.fill('20');
      await first.press('Tab');
      await page.getByRole('button', { name: 'Fork with the attack at k = 20…20' }).click();
      const fork = await forkOf(page);
      assert.deepEqual([fork.document.adversary.burst.from, fork.document.adversary.burst.to], [20, 20]);
      await view.close();
    });
  });

  test('begins an attack anew that has not begun, at its new time', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const run = await call(server, 'POST', '/runs', { scenario: 'sparse', seed: 3, pace: 5 });
    await until('it has begun', async () => (await call(server, 'GET', `/runs/${run.id}`)).progress.k > 2);
    await call(server, 'PATCH', `/runs/${run.id}`, { state: 'paused' });
    await view.goto(`/live/${run.id}`);
    const bar = page.locator('[data-bar="node1"]');
    await bar.focus();
    await bar.press('ArrowRight');
    await until('it is to begin a tick later', async () => (await bar.getAttribute('aria-valuetext')) === 'k = 181 until stopped');
    await page.getByRole('button', { name: 'Start it anew from k = 181' }).waitFor();
    await bar.press('Enter');
    const commands = await until('the run has both commands', async () => {
      const now = await call(server, 'GET', `/runs/${run.id}`);
      return now.commands.length === 2 ? now.commands.map(({ body }) => body) : null;
    });
    const { type, on, from } = commands[0].attack;
    assert.deepEqual({ type, on, from }, { type: 'radar_fdi', on: ['sensor:1'], from: 181 });
    assert.equal(commands[1].end_attack, 'node1');
    await until('its old bar is gone', async () => (await bar.count()) === 0);
    await page.locator(`[data-bar="${commands[0].attack.id}"]`).waitFor();
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });

  test('changes the threshold of a detector while the run goes on', async () => {
    const view = await openPage(browser, server);
    const { page } = view;
    const detector = { type: 'chi_square', params: { alpha: 0.001 } };
    const run = await openLive(view, server, call, { patch: { time: { steps: null }, lanes: { isolated: { detector } } } });
    await button(page, 'Parameters').click();
    const dialog = page.getByRole('dialog', { name: 'Parameters' });
    const alpha = dialog.locator('[id$="/lanes/isolated/detector/params/alpha"]');
    await alpha.waitFor({ state: 'attached' });
    await alpha.evaluate((input) => {
      for (let fold = input.closest('details'); fold; fold = fold.parentElement?.closest('details')) fold.open = true;
    });
    await alpha.fill('0.2');
    await dialog.getByRole('button', { name: 'Apply' }).click();
    const { k } = await until('the command is part of the run', async () => {
      const { commands } = await call(server, 'GET', `/runs/${run.id}`);
      return commands.find(({ body }) => body.params?.['lanes.isolated.detector.params.alpha'] === 0.2);
    });
    const [before, after] = await until('the threshold is lower from that tick on', async () => {
      const { series } = await call(server, 'GET', `/runs/${run.id}/samples?signals=lane.isolated.4.threshold&from=${k - 1}&to=${k}&points=9`);
      const values = series[0].v ?? [];
      return values.length === 2 && values.every((value) => typeof value === 'number') ? values : null;
    });
    assert.ok(after < before / 3, `${before} then ${after}`);
    await view.close();
    await call(server, 'DELETE', `/runs/${run.id}`);
  });
});
