// What a privacy guarantee covers: every observer, neighbouring releases and sampled losses, traces over kappa, epsilon and delta.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { openRange, query } from './support/live.mjs';
import { everyScenario, near, shareAbove, tableOf } from './support/privacy.mjs';
import { finishedRun, until } from './support/server.mjs';
import { withSite } from './support/site.mjs';
import { everyTick, panel } from './support/sparse.mjs';

describe('what the privacy family guarantees', () => {
  let server;
  let browser;
  let [runs, open] = [];
  withSite(async (site) => {
    ({ server, browser } = site);
    ({ runs, open } = await everyScenario(site));
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
});
