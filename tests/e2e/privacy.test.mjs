// The privacy family's panels: tracks, squared errors, the index and its ranks, messages, surfaces, releases, guarantees; listening by hand.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { checkAxe } from './support/axe.mjs';
import { openPage } from './support/browser.mjs';
import { button, csvOf, openRange, query, tickPast } from './support/live.mjs';
import { call, finishedRun, runUntil, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { everyTick, panel } from './support/sparse.mjs';

const word = (lane) => lane.replaceAll('_', ' ');
/** As the page writes it: three significant digits. */
const near = (text, value) => assert.ok(Math.abs(Number(text) - value) <= 0.006 * Math.abs(value) + 1e-12, `${text} for ${value}`);
const rowsOf = (place) => place.locator('tbody tr').evaluateAll((list) => list.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
const ranks = ['low', 'relatively low', 'medium', 'relatively high', 'high'];
const common = ['Tracks', 'Squared errors', 'Confidentiality', 'Messages', 'Events'];
const scenarios = {
  'privacy-robot-linear': common,
  'privacy-robot-nonlinear': common,
  'privacy-turn': [...common, 'Noise and error', 'Neighbouring releases', 'What is guaranteed'],
  'privacy-engine': [...common, 'Neighbouring releases', 'What is guaranteed'],
};

/** The panel's data as the page's own table: its columns and its rows, once every cell has its value. */
async function tableOf(page, title, complete = (cells) => cells.every((cell) => cell !== '')) {
  const place = panel(page, title);
  const turn = place.getByRole('button', { name: `${title}: Data as a table` });
  await turn.click();
  const rows = await until(`the table of ${title} is filled`, async () => {
    const all = await rowsOf(place);
    return all.length > 0 && all.every(complete) && all;
  });
  const columns = await place.locator('thead th').allInnerTexts();
  await turn.click();
  return { columns, rows };
}

/** The fraction of the numbers that exceed a bound. */
function shareAbove(values, bound) {
  const numbers = values.filter((value) => value !== null);
  return { n: numbers.length, share: numbers.filter((value) => value > bound).length / numbers.length };
}

describe('the privacy family', () => {
  let server;
  let browser;
  const runs = {};
  withSite(async (site) => {
    ({ server, browser } = site);
    for (const scenario of Object.keys(scenarios)) runs[scenario] = await finishedRun(server, { scenario });
  });

  async function open(scenario, more = '', options = {}) {
    const run = runs[scenario];
    const view = await openRange(browser, server, run.id, run.progress.k, more, options);
    await view.page.locator('.tracks canvas').first().waitFor();
    return view;
  }
  const lanesOf = (scenario) => runs[scenario].world.lanes.map(({ id }) => id);
  const lastOf = async (scenario, names) => {
    const run = runs[scenario];
    const { of } = await everyTick(server, run.id, names, run.progress.k);
    return Object.fromEntries(names.map((name) => [name, of[name].at(-1)]));
  };

  for (const [scenario, titles] of Object.entries(scenarios)) {
    test(`${scenario} has its panels, and every lane’s index in the strip`, async () => {
      const view = await open(scenario);
      for (const title of titles) await panel(view.page, title).waitFor();
      assert.equal(await view.page.locator('.grid > .cell').count(), titles.length);
      const lanes = lanesOf(scenario);
      const measured = await lastOf(scenario, lanes.flatMap((lane) => [`lane.${lane}.ci`, `lane.${lane}.ci_mse`, `lane.${lane}.rank`]));
      for (const lane of lanes) {
        const figure = view.page.locator('.figure.lane', { hasText: word(lane) });
        const text = await until(`the index of ${lane} is there`, async () => ((said) => !said.includes('–') && said)(await figure.innerText()));
        near(/-?\d\S*(?=\s+CI)/.exec(text)[0], measured[`lane.${lane}.ci`] ?? measured[`lane.${lane}.ci_mse`]);
        assert.ok(text.trim().endsWith(ranks[measured[`lane.${lane}.rank`]]), text);
      }
      await view.close();
    });
  }

  test('a track over time is the true component, the user’s and the eavesdropper’s, as the log has them', async () => {
    const scenario = 'privacy-robot-linear';
    const view = await open(scenario, '&lane=contamination');
    const { rows } = await tableOf(view.page, 'Tracks');
    const names = ['lane.contamination.eve.fusing.estimate.position', 'lane.contamination.fused.estimate.position', 'truth.position'];
    const { of } = await everyTick(server, runs[scenario].id, names, 100);
    assert.equal(rows.length, 100);
    for (const [k, ...cells] of rows) names.forEach((name, i) => near(cells[i], of[name][k]));
    // Section 2.5: about half the position. Its shape leaks, and the page says so.
    const share = of[names[0]].at(-1) / of[names[2]].at(-1);
    assert.ok(share > 0.4 && share < 0.6, `${share}`);
    await panel(view.page, 'Tracks').getByText('its shape leaks').waitFor();
    await view.close();
  });

  test('where the state has a plane the paths are drawn in it, and each component over time', async () => {
    const view = await open('privacy-robot-nonlinear', '&lane=contamination&k=60');
    const { page } = view;
    const tracks = panel(page, 'Tracks');
    await tracks.getByRole('img', { name: /^Paths in the plane up to tick 60, contamination: eavesdropper, fusing, user, true$/ }).waitFor();
    await tracks.getByRole('button', { name: 'over time' }).click();
    await tracks.getByRole('combobox', { name: 'Component' }).selectOption('theta');
    await tracks.getByRole('application', { name: /^theta over time/ }).waitFor();
    assert.equal(query(page, 'tracks'), 'theta');
    await tracks.getByRole('button', { name: 'plane' }).click();
    await until('the address is plain again', () => query(page, 'tracks') === null);
    await view.close();
  });

  test('squared errors have the traces beside them; curves and eavesdroppers are chosen; the CSV has what is drawn', async () => {
    const scenario = 'privacy-engine';
    const view = await open(scenario, '&lane=two_step');
    const { page } = view;
    const squares = panel(page, 'Squared errors');
    const head = (name) => `lane.two_step.${name}`;
    const { columns, rows } = await tableOf(page, 'Squared errors', (cells) => cells.filter((cell) => cell === '').length === 0);
    assert.deepEqual(columns.slice(-2), ['user, covariance', 'user']);
    const { of } = await everyTick(server, runs[scenario].id, [head('fused.trace'), head('fused.square')], 200);
    for (const [k, ...cells] of rows) {
      near(cells.at(-2), of[head('fused.trace')][k]);
      near(cells.at(-1), of[head('fused.square')][k]);
    }
    await squares.getByRole('button', { name: 'covariances' }).click();
    await squares.getByRole('button', { name: 'eavesdropper, window mean' }).click();
    await squares.getByRole('button', { name: 'sent', exact: true }).click();
    await until('the address has the curves', () => query(page, 'curves') === 'other.window_mean,sent' && query(page, 'traces') === 'off');
    assert.equal(await panel(page, 'Tracks').getByRole('button', { name: 'eavesdropper, window mean' }).getAttribute('aria-pressed'), 'false', 'on every panel');
    const [download] = await Promise.all([page.waitForEvent('download'), squares.getByRole('button', { name: /as CSV/ }).click()]);
    const [names, ...lines] = await csvOf(download);
    assert.deepEqual(names.slice(2).toSorted(), ['1.sent_square', '2.sent_square', 'eve.differencing.square', 'fused.square', 'optimal.square'].map(head).toSorted());
    assert.equal(lines.length, 201);
    await view.close();
  });

  test('users and eavesdroppers of all lanes are compared in one picture', async () => {
    const view = await open('privacy-engine', '&lane=two_step');
    const { page } = view;
    const squares = panel(page, 'Squared errors');
    await squares.getByRole('button', { name: 'users', exact: true }).click();
    const lanes = lanesOf('privacy-engine').map(word);
    for (const lane of lanes) await squares.getByRole('application', { name: new RegExp(`legitimate user.*${lane}`) }).waitFor();
    await squares.getByRole('button', { name: 'eavesdroppers', exact: true }).click();
    await squares.getByRole('application', { name: /two step, differencing.*two step, window mean.*contamination, fusing/ }).waitFor();
    await squares.getByRole('button', { name: 'contamination', exact: true }).click();
    await until('a hidden lane is not drawn', async () => !(await squares.getByRole('application').getAttribute('aria-label')).includes('contamination'));
    assert.equal(query(page, 'squares'), 'eves');
    await view.close();
  });

  test('the gauge says every lane’s index, its rank, other eavesdroppers and the paper’s number: infinite is no number', async () => {
    const scenario = 'privacy-engine';
    const view = await open(scenario);
    const place = panel(view.page, 'Confidentiality');
    const names = [...lanesOf(scenario).map((lane) => `lane.${lane}.ci`), 'lane.two_step.eve.window_mean.ci'];
    const of = await lastOf(scenario, names);
    const label = await until('the gauge has every lane', async () => {
      const text = await place.getByRole('img').getAttribute('aria-label');
      return !text.includes('nothing yet') && /window mean \d/.test(text) && text;
    });
    for (const lane of lanesOf(scenario)) {
      const [, ci, rank] = new RegExp(`[:;] ${word(lane)} (\\S+), ([a-z ]+), CI of covariances`).exec(label);
      near(ci, of[`lane.${lane}.ci`]);
      assert.equal(rank, ranks[[1, 2, 4, 8].filter((bound) => of[`lane.${lane}.ci`] >= bound).length]);
    }
    near(/two step.*window mean (-?[\d.]+)/.exec(label)[1], of['lane.two_step.eve.window_mean.ci']);
    assert.match(label, /two step [^;]*the paper prints infinite/);
    assert.match(label, /contamination [^;]*the paper prints 1\.23/);
    assert.match(label, /secrecy code a [^;]*the paper prints 3\.66/);
    await view.close();
  });

  test('beside the index stand the analytic slope, the paper’s claim and whom it leaves out', async () => {
    const scenario = 'privacy-engine';
    const { design } = runs[scenario];
    const view = await open(scenario);
    const place = panel(view.page, 'Confidentiality');
    const grows = await place.getByText('the variance of the differencing eavesdropper grows by').innerText();
    near(/grows by (\S+) per step/.exec(grows)[1], design.two_step.slope);
    near(/leaks (\S+)\)/.exec(grows)[1], design.two_step.leak);
    const ci = (await lastOf(scenario, ['lane.two_step.ci', 'lane.two_step.eve.window_mean.ci']));
    near(/every step: (\S+) now/.exec(grows)[1], ci['lane.two_step.ci']);
    const said = await until('the window mean is told', async () => ((text) => /index of \d/.test(text) && text)(await place.getByText('Theorem 4.2').innerText()));
    near(/an index of (\S+), rank low/.exec(said)[1], ci['lane.two_step.eve.window_mean.ci']);
    assert.ok(ci['lane.two_step.eve.window_mean.ci'] < 1);
    // At another tick it is another index.
    await panel(view.page, 'Squared errors').getByRole('application').focus();
    await view.page.keyboard.press('0');
    for (let i = 0; i < 3; i++) await view.page.keyboard.press('Shift+ArrowLeft');
    const { of } = await everyTick(server, runs[scenario].id, ['lane.two_step.ci'], 200);
    const k = Number(await until('the cursor is set', () => query(view.page, 'k')));
    await until('the index is the cursor’s', async () => Math.abs(Number(/every step: (\S+) now/.exec(await place.getByText('grows by').innerText())[1]) - of['lane.two_step.ci'][k]) < 0.006 * of['lane.two_step.ci'][k]);
    await view.close();
  });

  test('contaminated components are a raster, as the log has them; the network shows them at the cursor', async () => {
    const scenario = 'privacy-robot-linear';
    const view = await open(scenario, '&lane=contamination&k=10');
    const { page } = view;
    const { rows } = await tableOf(page, 'Messages', (cells) => cells.length === 9 && cells.at(-4) === 'E');
    const names = ['1', '2'].flatMap((node) => ['position', 'velocity'].map((component) => `lane.contamination.${node}.contaminated.${component}`));
    const { of } = await everyTick(server, runs[scenario].id, names, 100);
    for (const [k, ...cells] of rows) names.forEach((name, i) => assert.equal(cells[i], of[name][k] ? 'C' : '', `${name} at ${k}`));
    const own = (node) => names.filter((name) => name.startsWith(`lane.contamination.${node}.`) && of[name][10]).map((name) => name.split('.').at(-1)).join(', ');
    const label = await until('the picture has the cursor’s tick', async () => ((text) => text.includes('contaminates') && text)(await panel(page, 'Messages').getByRole('img').getAttribute('aria-label')));
    assert.match(label, /tick 10: link from 1 to fused is overheard/);
    for (const node of ['1', '2']) assert.ok(label.includes(`${node} contaminates ${own(node)}`), label);
    await view.close();
  });

  for (const [scenario, lane] of [['privacy-turn', 'dp_uniform'], ['privacy-turn', 'dp_one_sensor'], ['privacy-engine', 'two_step']]) {
    test(`the guarantee of ${lane}: every observer exactly, and sampled as the log has it`, async () => {
      const design = runs[scenario].design[lane];
      const view = await open(scenario, `&lane=${lane}`);
      const observers = Object.entries(design.views).flatMap(([name, nodes]) => Object.entries(nodes).map(([node, one]) => ({ node, ...one, signal: one.infinite ? null : `lane.${lane}.${node}.loss.${name}` })));
      const sampled = observers.filter(({ signal }) => signal);
      const { of } = await everyTick(server, runs[scenario].id, sampled.map(({ signal }) => signal), runs[scenario].progress.k);
      const { rows } = await tableOf(view.page, 'What is guaranteed', (cells) => cells.length === 10);
      assert.equal(rows.length, observers.length);
      observers.forEach(({ node, mu, p_loss: pLoss, eps_at_delta: eps, infinite, signal }, i) => {
        const [, who, muText, exact, share, n, , epsText, muVerdict, dpVerdict] = rows[i];
        assert.equal(who, node === 'fused' ? 'centre' : node);
        near(exact, pLoss);
        if (infinite) {
          assert.deepEqual([muText, share, epsText, muVerdict, dpVerdict], ['∞', '–', '∞', 'μ ≤ 1/Γ fails', '(ε, δ) fails']);
          return;
        }
        near(muText, mu);
        near(epsText, eps);
        assert.equal(muVerdict, `μ ≤ 1/Γ ${mu <= design.views_design_mu * (1 + 1e-9) ? 'holds' : 'fails'}`);
        assert.equal(dpVerdict, `(ε, δ) ${eps <= design.epsilon ? 'holds' : 'fails'}`);
        const own = shareAbove(of[signal], design.epsilon);
        assert.equal(Number(n), own.n);
        const [, found, lo, hi] = /^(\S+) \((\S+) … (\S+)\)$/.exec(share).map(Number);
        near(found, own.share);
        assert.ok(lo <= found && found <= hi && hi - lo < 1, share);
      });
      await panel(view.page, 'What is guaranteed').getByText('Losses of successive ticks overlap').waitFor();
      await view.close();
    });
  }

  test('a mechanism whose condition fails says so plainly', async () => {
    const run = await finishedRun(server, { scenario: 'privacy-engine', patch: { time: { steps: 50 }, lanes: { two_step: { protection: { params: { q_xi: [1e-5, 1e-5], q_alpha: 1e-6 } } } } } });
    assert.equal(run.design.two_step.dp_ok, false);
    const view = await openRange(browser, server, run.id, 50, '&lane=two_step');
    await panel(view.page, 'What is guaranteed').getByText('dp_ok: no').waitFor();
    await view.close();
  });

  test('a lane that promises nothing says why, and leads to one that does', async () => {
    const view = await open('privacy-engine', '&lane=contamination');
    const { page } = view;
    const card = panel(page, 'What is guaranteed');
    await card.getByText('Lane contamination promises no differential privacy.').waitFor();
    await card.getByRole('button', { name: 'Look at two step' }).click();
    await until('the address has the lane', () => query(page, 'lane') === 'two_step');
    await card.getByRole('table').waitFor();
    await view.close();
  });

  test('neighbouring releases and sampled losses are drawn for any release and any observer', async () => {
    const scenario = 'privacy-engine';
    const design = runs[scenario].design.two_step;
    const view = await open(scenario, '&lane=two_step');
    const place = panel(view.page, 'Neighbouring releases');
    const release = design.releases.at(-1);
    await place.getByRole('combobox', { name: 'Release' }).selectOption({ label: `${release.node}, ${release.component}` });
    const laws = place.getByRole('img', { name: /^Densities of a release/ });
    const [, std, shift] = /standard deviation (\S+), means apart by (\S+)$/.exec(await until('the release is drawn', async () => ((text) => text.includes(`${release.node}, ${release.component}`) && text)(await laws.getAttribute('aria-label'))));
    near(std, release.std);
    near(shift, release.shift);
    await place.getByRole('combobox', { name: 'Loss of' }).selectOption({ label: 'difference of two messages, 2' });
    const { of } = await everyTick(server, runs[scenario].id, ['lane.two_step.2.loss.difference'], 200);
    const { n } = shareAbove(of['lane.two_step.2.loss.difference'], 0);
    const label = await until('its samples are read', async () => ((text) => text.includes(`${n} samples`) && text)(await place.getByRole('img', { name: /^Privacy loss of difference of two messages, 2/ }).getAttribute('aria-label')));
    const { mu } = design.views.difference[2];
    near(/standard deviation (\S+)$/.exec(label)[1], mu);
    near(/mean (\S+),/.exec(label)[1], (mu * mu) / 2);
    await view.close();
  });

  test('the surfaces are the design’s own numbers, and fall as the section says', async () => {
    const { surfaces, epsilon } = runs['privacy-turn'].design.dp_uniform;
    const view = await open('privacy-turn', '&lane=dp_uniform');
    const place = panel(view.page, 'Noise and error');
    await place.getByRole('img', { name: /^Traces over κ/ }).waitFor();
    await place.getByRole('button', { name: 'PDFE over ε, δ' }).click();
    await place.getByRole('img', { name: /^Trace of eavesdropper \(PDFE\) over ε and δ.*: yes$/ }).waitFor();
    await place.getByRole('button', { name: 'CDFE over ε, δ' }).click();
    await until('the address has it', () => query(view.page, 'surface') === 'cdfe');
    await place.getByRole('img', { name: /^Trace of user \(CDFE\) over ε and δ.*: yes$/ }).waitFor();
    const { rows } = await tableOf(view.page, 'Noise and error');
    const all = [...surfaces.kappa.values.map((_, i) => [surfaces.kappa.pdfe[i], surfaces.kappa.cdfe[i]]), ...surfaces.epsilon_delta.epsilon.flatMap((_, i) => surfaces.epsilon_delta.delta.map((__, j) => [surfaces.epsilon_delta.pdfe[i][j], surfaces.epsilon_delta.cdfe[i][j]]))];
    assert.ok(epsilon > 0);
    all.slice(0, rows.length).forEach((pair, i) => pair.forEach((value, j) => near(rows[i][j + 1], value)));
    // Section 3.4: kappa = 10.
    const ten = surfaces.kappa.values.indexOf(10);
    if (ten >= 0) assert.ok(Math.abs(surfaces.kappa.pdfe[ten] - 1.0969) < 1e-3 && Math.abs(surfaces.kappa.cdfe[ten] - 0.8632) < 1e-3);
    await view.close();
  });

  test('listening starts by hand, with the keyboard, on a chosen link; the page shows who is overheard from then on', async () => {
    const { id } = await call(server, 'POST', '/runs', { scenario: 'privacy-robot-linear', pace: 20, patch: { time: { steps: null }, adversary: { eve: null } } });
    await runUntil(server, id, 'running');
    const view = await openPage(browser, server);
    const { page } = view;
    await view.goto(`/live/${id}`);
    await tickPast(page, 2);
    const picture = panel(page, 'Messages').getByRole('img');
    await until('nobody listens', async () => (await picture.getAttribute('aria-label')).includes('link from 1 to fused is not overheard'));
    await button(page, 'Attack a link').focus();
    await page.keyboard.press('Enter');
    const dialog = page.getByRole('dialog', { name: 'Attack a link' });
    await dialog.getByRole('combobox', { name: 'Attack' }).selectOption('eavesdrop');
    await dialog.getByRole('checkbox', { name: 'all links' }).focus();
    await page.keyboard.press('Space');
    await dialog.getByRole('button', { name: '2→fused' }).focus();
    await page.keyboard.press('Enter');
    await dialog.getByRole('button', { name: 'Start the attack' }).focus();
    await page.keyboard.press('Enter');
    await until('one link is overheard', async () => ((text) => text.includes('link from 2 to fused is overheard') && text.includes('link from 1 to fused is not overheard'))(await picture.getAttribute('aria-label')));
    await panel(page, 'Events').getByText(/eavesdrop/).first().waitFor();
    await view.close();
    await call(server, 'DELETE', `/runs/${id}`);
  });

  test('keys and charts of the panels are reached and used by keyboard', async () => {
    const view = await open('privacy-engine', '&lane=two_step');
    const { page } = view;
    const key = panel(page, 'Tracks').getByRole('button', { name: 'eavesdropper, zero estimate' });
    await key.focus();
    await page.keyboard.press('Enter');
    await until('the zero estimate is drawn', async () => (await key.getAttribute('aria-pressed')) === 'true' && query(page, 'curves') === 'other.zero');
    await panel(page, 'Tracks').getByRole('application', { name: /zero estimate/ }).waitFor();
    await page.keyboard.press('Space');
    await until('and no longer', async () => (await key.getAttribute('aria-pressed')) === 'false');
    const reached = await panel(page, 'What is guaranteed').getByRole('group', { name: /^What every observer learns/ });
    await reached.focus();
    assert.equal(await reached.evaluate((place) => place === document.activeElement), true);
    await view.close();
  });

  const looks = [['privacy-robot-linear', 'light', 'en', 1440], ['privacy-robot-nonlinear', 'dark', 'zh', 1024], ['privacy-turn', 'light', 'zh', 390], ['privacy-turn', 'dark', 'en', 1440], ['privacy-engine', 'dark', 'zh', 390], ['privacy-engine', 'light', 'en', 1024], ['privacy-engine', 'light', 'zh', 1440]];
  for (const [scenario, theme, lang, width] of looks) {
    test(`nothing for axe to say, nothing wider than the screen: ${scenario}, ${theme}, ${lang}, ${width} px`, async () => {
      const view = await open(scenario, '&k=40', { theme, lang, width });
      const { page } = view;
      await page.locator('.confidentiality canvas').first().waitFor();
      await page.locator('.messages canvas').first().waitFor();
      if (scenarios[scenario].includes('What is guaranteed')) await page.locator('.guarantee td').first().waitFor();
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
      await checkAxe(page, `the privacy panels of ${scenario}, ${theme} ${lang} ${width}`);
      await view.close();
    });
  }
});
