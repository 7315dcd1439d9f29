// The papers, run again: from the list, with verdicts as the API says them, figures from our data, and files to take away.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { button } from './support/live.mjs';
import { counted, said } from './support/said.mjs';
import { call, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';

const literal = (text) => text.replace(/[\\^$.*+?()[\]{}|]/g, '\\$&');
const words = { reproduced: 'reproduced', 'reproduced after correction': 'after correction', 'not reproduced': 'not reproduced' };

describe('papers', () => {
  let server;
  let browser;

  const list = () => call(server, 'GET', '/papers');
  const itemOf = async (key) => (await list()).items.find((item) => item.key === key);
  const ended = () => until('the job is over', async () => (await list()).job?.state !== 'running');

  async function run(order) {
    await call(server, 'POST', '/papers', order);
    await ended();
  }

  withSite(async (site) => {
    ({ server, browser } = site);
    await run({ only: ['000/fig1', '000/fig4', '001/fig2', '002/fig7', '004/fig2-3'], runs: 4, seed: 5 });
  });

  const row = (page, key) => page.getByRole('row', { name: new RegExp(`^Choose ${key} `) });
  const open = async (path, options) => {
    const view = await openPage(browser, server, options);
    await view.goto(path);
    return view;
  };

  test('is an entry of the rail and lists every item with its verdict', async () => {
    const view = await open('/');
    const { page } = view;
    await page.getByRole('navigation', { name: 'Pages' }).getByRole('link', { name: 'Papers' }).click();
    await page.getByRole('heading', { level: 1, name: 'The papers, run again' }).waitFor();
    const { items } = await list();
    await counted(page.getByRole('row', { name: /^Choose 00/ }), items.length);
    assert.equal(items.length, 41);
    for (const item of items.filter((one) => one.verdict !== null)) {
      await said(row(page, item.key), new RegExp(words[item.verdict]));
      await said(row(page, item.key), /seed 5/);
    }
    await said(row(page, '003/fig5'), /not run yet/);
    await view.close();
  });

  test('shows the items of one verdict; the address keeps which', async () => {
    const view = await open('/papers');
    const { page } = view;
    const { items } = await list();
    const rows = page.getByRole('row', { name: /^Choose 00/ });
    await page.getByRole('button', { name: /^not reproduced/ }).click();
    await counted(rows, items.filter((item) => item.verdict === 'not reproduced').length);
    await page.reload();
    await counted(rows, items.filter((item) => item.verdict === 'not reproduced').length);
    await page.getByRole('button', { name: /^not run yet/ }).click();
    await counted(rows, items.filter((item) => item.verdict === null).length);
    await page.getByRole('button', { name: /^all/ }).click();
    await counted(rows, items.length);
    await view.close();
  });

  test('runs one item, and those that are chosen, with the keyboard', async () => {
    const view = await open('/papers');
    const { page } = view;
    const before = await itemOf('000/fig1');
    await page.getByRole('spinbutton', { name: 'Runs of each campaign' }).fill('3');
    await page.getByRole('spinbutton', { name: 'First seed' }).fill('77');
    await button(page, 'Run 000/fig1').focus();
    await page.keyboard.press('Enter');
    await said(row(page, '000/fig1'), /seed 77/);
    await page.getByText('The last job is done. Items: 1; runs of each campaign: 3; first seed: 77.').waitFor();
    const after = await itemOf('000/fig1');
    assert.equal(after.seed, 77);
    assert.notEqual(after.ended, before.ended);
    for (const key of ['000/fig2', '004/eq4-33']) {
      await page.getByRole('checkbox', { name: `Choose ${key}`, exact: true }).focus();
      await page.keyboard.press('Space');
    }
    await button(page, 'Run the 2 chosen').click();
    for (const key of ['000/fig2', '004/eq4-33']) await said(row(page, key), /seed 77/);
    assert.deepEqual((await list()).job.items, ['000/fig2', '004/eq4-33']);
    await view.close();
  });

  test('shows how far a job is and cancels it', async () => {
    const view = await open('/papers');
    const { page } = view;
    await page.getByRole('spinbutton', { name: 'Runs of each campaign' }).fill('10000');
    await button(page, 'Run 003/fig4').click();
    await page.getByText('now 003/fig4').waitFor();
    await page.getByText('0 of 1 items').waitFor();
    assert.equal(await button(page, 'Run 000/fig1').isDisabled(), true);
    await button(page, 'Cancel').click();
    await page.getByText('The last job was cancelled after 0 of 1 items.').waitFor();
    assert.equal((await itemOf('003/fig4')).verdict, null);
    await view.close();
  });

  test('an item shows its reason, its claims and its figure, as the API has them', async () => {
    const view = await open('/papers');
    const { page } = view;
    await page.getByRole('link', { name: '000/fig4', exact: true }).click();
    const item = await call(server, 'GET', '/papers/000/fig4');
    await said(page.getByRole('article'), new RegExp(literal(item.reason.replaceAll('`', ''))));
    await said(page.getByRole('article'), new RegExp(literal(item.rule.replaceAll('`', ''))));
    assert.equal(new URL(page.url()).searchParams.get('item'), '000/fig4');
    const claims = page.getByRole('region', { name: 'Claims' }).locator('tbody tr');
    await counted(claims, item.figure.claims.length);
    for (const [i, claim] of item.figure.claims.entries()) await said(claims.nth(i), claim.holds ? /holds$/ : /does not hold$/);
    const figures = page.locator('figure');
    await counted(figures, item.figure.panels.length);
    for (const [i, panel] of item.figure.panels.entries()) {
      const lines = panel.series.filter(({ style }) => style !== 'points' && style !== 'stems');
      await counted(figures.nth(i).locator('svg[role=img] path'), lines.length);
      const paths = await figures.nth(i).locator('svg[role=img] path').evaluateAll((all) => all.map((path) => path.getAttribute('d')));
      for (const [k, path] of paths.entries()) {
        assert.ok(!/NaN|Infinity/.test(path));
        const points = lines[k].x.filter((x, j) => x !== null && lines[k].y[j] !== null).length;
        if (lines[k].style === 'line' && panel.x.scale === 'linear' && panel.y.scale === 'linear') assert.equal(path.match(/[ML]/g).length, points, `${lines[k].name}: every point is drawn`);
      }
    }
    await page.getByText('vigil papers --only 000/fig4 --runs 200 --seed 1').waitFor();
    await page.getByRole('link', { name: 'Next: 000/fig5' }).click();
    await page.getByText('This item was never run here').waitFor();
    await page.getByRole('link', { name: 'All items' }).click();
    await row(page, '000/fig4').waitFor();
    await view.close();
  });

  test('leads to the scenario, and gives the figure as files and everything as one page', async () => {
    const view = await open('/papers?item=000/fig4');
    const { page } = view;
    const saved = async (place) => {
      const waiting = page.waitForEvent('download');
      await place.click();
      return readFileSync(await (await waiting).path(), 'utf8');
    };
    const item = await call(server, 'GET', '/papers/000/fig4');
    const [panel] = item.figure.panels;
    const csv = (await saved(button(page, `CSV of ${panel.title}`).first())).trim().split('\n');
    assert.equal(csv.length, 1 + panel.series.reduce((sum, series) => sum + series.x.length, 0));
    const svg = await saved(button(page, `SVG of ${panel.title}`).first());
    assert.match(svg, /^<svg [^>]*xmlns="http:\/\/www\.w3\.org\/2000\/svg"/);
    assert.doesNotMatch(svg, /var\(/);
    const report = await saved(page.getByRole('link', { name: 'Report as one page' }));
    assert.match(report, /^<!doctype html>/);
    assert.ok(report.includes('id="000/fig4"') && report.includes('<svg'));
    await page.getByRole('link', { name: item.scenario, exact: true }).click();
    await until('the scenario is open', async () => new URL(page.url()).pathname === `/scenarios/${item.scenario}`);
    await page.getByRole('heading', { level: 1 }).waitFor();
    await view.close();
  });

  test('an item shows its equations as the browser draws them, and leads to its methods', async () => {
    const view = await open('/papers?item=000/fig4');
    const { page } = view;
    const item = await call(server, 'GET', '/papers/000/fig4');
    const drawn = page.locator('details.equations math');
    await counted(drawn, item.equations.length);
    // Native MathML: a fraction is taller than its numerator, which needs a browser that lays it out.
    const tall = await page.locator('details.equations mfrac').first().evaluate((fraction) => fraction.getBoundingClientRect().height / fraction.firstElementChild.getBoundingClientRect().height);
    assert.ok(tall > 1.5, `a fraction is laid out: ${tall}`);
    for (const one of item.equations) assert.ok(one.mathml.startsWith('<math'));
    await page.getByRole('link', { name: 'Consensus filter', exact: true }).click();
    await page.getByRole('heading', { level: 1, name: 'Consensus filter' }).waitFor();
    const method = await call(server, 'GET', '/documentation/consensus_ekf');
    await counted(page.locator('math'), method.equations.length);
    await counted(page.locator('table tbody tr'), method.parameters.length);
    await page.getByRole('link', { name: 'All methods' }).click();
    await page.getByRole('link', { name: 'omp_game', exact: true }).waitFor();
    await view.close();
  });

  test('one click makes the run of a figure and opens it; a second one opens the same', async () => {
    const view = await open('/papers?item=000/fig4');
    const { page } = view;
    const item = await call(server, 'GET', '/papers/000/fig4');
    const go = async () => {
      await view.goto('/papers?item=000/fig4');
      await button(page, 'Run and open: corrected units').click();
      await page.waitForURL(/\/live\/\d+/);
      return new URL(page.url()).pathname.split('/').pop();
    };
    const id = await go();
    await until('the run is over', async () => (await call(server, 'GET', `/runs/${id}`)).state === 'finished');
    const run = await call(server, 'GET', `/runs/${id}`);
    assert.equal(run.seed, item.seed);
    assert.deepEqual(run.tags, ['papers', '000/fig4']);
    // The run is the figure's: its truth is the curve of the first panel.
    const samples = await call(server, 'GET', `/runs/${id}/samples?signals=truth.x`);
    const truth = item.figure.panels[0].series.find((series) => series.name === 'truth');
    assert.deepEqual(samples.series[0].v ?? samples.series[0].lo, truth.x);
    assert.equal(await go(), id);
    await view.close();
  });

  test('speaks Chinese: reason, rule, claims, and the words of the figure', async () => {
    const view = await open('/papers?item=000/fig4', { lang: 'zh' });
    const { page } = view;
    const item = await call(server, 'GET', '/papers/000/fig4');
    await said(page.getByRole('article'), new RegExp(literal(item.zh.reason.replaceAll('`', ''))));
    await said(page.getByRole('article'), new RegExp(literal(item.zh.rule)));
    const claims = page.getByRole('region', { name: '论断' }).locator('tbody tr');
    for (const [i, claim] of item.figure.claims.entries()) await said(claims.nth(i), new RegExp(literal(claim.zh.what)));
    await page.getByRole('heading', { level: 4, name: item.figure.panels[0].zh.title }).waitFor();
    await view.close();
  });

  for (const address of ['/papers?item=009/fig1', '/papers/009/fig1']) {
    test(`says which item there is not, and shows the list: ${address}`, async () => {
      const view = await open(address);
      await view.page.getByRole('alert').getByText('There is no item 009/fig1.').waitFor();
      await row(view.page, '000/fig1').waitFor();
      await view.close();
    });
  }

  test('an item has an address to type and to cite', async () => {
    const view = await open('/papers/000/fig4');
    await view.page.getByRole('article').getByText('000/fig4').first().waitFor();
    await view.page.getByRole('link', { name: /^Next: 000\/fig5/ }).click();
    await view.page.getByRole('article').getByText('000/fig5').first().waitFor();
    await view.page.getByRole('link', { name: 'All items' }).click();
    await row(view.page, '000/fig4').waitFor();
    await view.close();
  });

  for (const [lang, theme, width] of [['en', 'light', 1440], ['zh', 'dark', 1024], ['en', 'dark', 390], ['zh', 'light', 390]]) {
    for (const [what, path] of [['list', '/papers'], ['item', '/papers?item=000/fig4'], ['table', '/papers?item=002/fig7'], ['methods', '/methods'], ['method', '/methods/consensus_ekf']]) {
      test(`has no barrier: ${what}, ${lang}, ${theme}, ${width} px`, async () => {
        const view = await open(path, { lang, theme, width });
        const { page } = view;
        await view.goto(path);
        await page.locator(what === 'list' || what === 'methods' ? 'tbody tr' : what === 'method' ? 'math' : 'tbody tr, figure').first().waitFor();
        await checkAxe(page, `papers ${what} ${lang} ${theme} ${width}`);
        for (const part of ['main', 'nav']) {
          const wide = await page.locator(part).first().evaluate((place) => place.scrollWidth - place.clientWidth);
          assert.ok(wide <= 0, `nothing is wider than ${part}: ${wide} px`);
        }
        await view.close();
      });
    }
  }
});
