import { beforeEach, describe, expect, it } from 'vitest';
import type { RunDetail } from '../../../api/types';
import type { Series } from '../../../data/series';
import { language } from '../../../i18n/i18n.svelte';
import { placesOf as attackPlaces, usualType } from '../attack_places';
import { laneOf, makeModel } from '../model';
import { panelsOf } from '../panels';
import { withCentre } from '../plane_draw';
import { componentsOf, curvesOf, hasCentre, isShown, planeOf, variantsOf } from './centre';
import { gaugePlace, gaugeScale, isFitted, paperIndex, rankOf, readingsAt } from './confidentiality';
import { clipped, curveKeys, eveSquares, laneSquares, lookOf, mostDrawn, trackLines, userSquares } from './curves';
import { designOf } from './design';
import { run, signals, surfaces, twoStep } from './fixture';
import { guaranteedLanes, rowsOf, sampledShare, viewWord } from './guarantee';
import { placesOf } from './network_draw';
import { independent, wilson } from './normal';
import { sentencesOf, type LaneFacts } from './sentences';
import { falls, indexOf } from './surfaces_draw';
import { t } from './words';

const model = makeModel(run, signals);
const lane = (id: string) => laneOf(model, id)!;
const series = (values: number[]): Series => {
  const lo = Float64Array.from(values);
  return { k: Float64Array.from(values, (_, i) => i), lo, hi: lo, joined: Uint8Array.from(values, (_, i) => (i ? 1 : 0)) };
};

beforeEach(() => language.set('en'));

describe('a fusion centre', () => {
  it('is told by its squared errors, and has its own panels and no plain errors', () => {
    expect(hasCentre(model)).toBe(true);
    expect(hasCentre(makeModel(run, signals.filter(({ name }) => !name.endsWith('.square'))))).toBe(false);
    expect(panelsOf({ ...run, family: 'other' }, model).map(({ name }) => name)).toEqual(['tracks', 'squares', 'confidentiality', 'guarantee', 'releases', 'messages', 'events', 'attacks']);
  });

  it('gives its panels room by what else there is', () => {
    const shown = (types: string[]): Record<string, readonly [number, number]> => {
      const document = { ...run.document, lanes: Object.fromEntries(types.map((type, i) => [model.lanes[i]!.id, { protection: { type } }])) };
      return Object.fromEntries(panelsOf({ ...run, document, design: {} }, model).map(({ name, wide }) => [name, wide]));
    };
    expect(shown(['contamination', 'complex_noise'])).toMatchObject({ tracks: [5, 2], messages: [8, 1], events: [4, 1] });
    expect(shown(['contamination'])).not.toHaveProperty('guarantee');
    expect(shown(['dp_centre', 'dp_sensors'])).toMatchObject({ surfaces: [5, 1], events: [3, 1], guarantee: [5, 1] });
  });

  it('keeps the entries of its panels, whatever the server says next: none is made anew', () => {
    const document = { ...run.document, lanes: { unprotected: { protection: { type: 'dp_centre' } } } };
    const entries = (): readonly object[] => panelsOf({ ...run, document }, model);
    entries().forEach((entry, i) => expect(entries()[i]).toBe(entry));
  });

  it('has curves of the user, what is best, the nodes and all who listen', () => {
    expect(curvesOf(model, lane('contamination')).map(({ id, node }) => (node === null ? id : `${id} ${node}`))).toEqual([
      'fused', 'optimal', 'local 1', 'local 2', 'sent 1', 'sent 2', 'compensated 1', 'compensated 2', 'eve.fusing', 'other.zero',
    ]);
    expect(variantsOf(model, lane('two_step'))).toEqual(['differencing', 'window_mean', 'zero']);
    expect(curvesOf(model, lane('two_step')).find(({ id }) => id === 'sent')).toMatchObject({ square: 'lane.two_step.1.sent_square', trace: null });
  });

  it('shows a curve or not, and the other way round once it is turned', () => {
    expect([isShown([], 'fused'), isShown(['fused'], 'fused'), isShown([], 'other.zero'), isShown(['other.zero'], 'other.zero')]).toEqual([true, false, false, true]);
  });

  it('knows a plane by its components, and positions before other components', () => {
    const names = ['vx', 'sx', 'sy'].map((name, id) => ({ id, name: `truth.${name}`, unit: '', kind: 'scalar' as const }));
    const moving = makeModel(run, names);
    expect(planeOf(run, moving)).toEqual(['sx', 'sy']);
    expect(planeOf(run, model)).toBeNull();
    expect(componentsOf(moving).map(({ name }) => name)).toEqual(['sx', 'sy', 'vx']);
  });

  it('is drawn in the plane in the middle of the nodes, as what it is', () => {
    expect(model.centre).toBe('fused');
    expect(withCentre([{ id: '1', position: [0, 0] }, { id: '2', position: [4, 2] }], 'fused')[2]).toEqual({ id: 'fused', position: [2, 1], centre: true });
    expect(withCentre(model.nodes, 'fused')).toBe(model.nodes);
    const { senders, centre } = placesOf(2, 120, 100);
    expect([senders[0]!.y, senders[1]!.y, centre.y]).toEqual([24, 76, 50]);
    expect(placesOf(1, 120, 100).senders[0]!.y).toBe(50);
  });

  it('can be listened to by hand, link by link', () => {
    expect(attackPlaces(model, 'link')).toEqual(['1-fused', '2-fused']);
    expect(usualType(run, ['dos', 'dos_fdi', 'eavesdrop', 'replay'], 'link')).toBe('eavesdrop');
    expect(usualType({ document: {} }, ['dos', 'dos_fdi', 'eavesdrop'], 'link')).toBe('dos_fdi');
  });
});

describe('lines', () => {
  it('of one lane have the user on top and each trace under its error, in its colour', () => {
    const lines = laneSquares(model, lane('contamination'), { turned: [], traces: true });
    expect(lines.at(-1)).toMatchObject({ signal: 'lane.contamination.fused.square', token: lane('contamination').token, strong: true });
    expect(lines.at(-2)).toMatchObject({ signal: 'lane.contamination.fused.trace', token: lane('contamination').token, width: 0.8 });
    expect(laneSquares(model, lane('contamination'), { turned: ['compensated', 'eve.fusing'], traces: false }).map(({ name }) => name)).toEqual(['optimal fusion', 'user']);
  });

  it('tell every curve of a lane from every other by colour and dash', () => {
    for (const { id, token } of model.lanes) {
      const looks = curvesOf(model, { id }).map((curve) => lookOf(curve, { token }, ['1', '2']));
      expect(new Set(looks.map((look) => `${look.token} ${look.dash.join()}`)).size).toBe(looks.length);
    }
  });

  it('of all users are in their lanes’ colours, with what is best once', () => {
    const lines = userSquares(model, model.lanes, lane('two_step'), { turned: [], traces: false });
    expect(lines.map(({ name, strong }) => [name, strong])).toEqual([['unprotected', false], ['two step', true], ['contamination', false], ['secrecy code a', false], ['optimal fusion', false]]);
    expect(lines.at(-1)!.signal).toBe('lane.two_step.optimal.square');
  });

  it('of all eavesdroppers name whom they are of', () => {
    const lines = eveSquares(model, [lane('two_step')], null, { turned: ['other.zero'], traces: false });
    expect(lines.map(({ name }) => name)).toEqual(['two step, differencing', 'two step, window mean', 'two step, zero estimate']);
    expect(new Set(lines.map(({ dash, width }) => `${dash.join()} ${width}`)).size).toBe(3);
  });

  it('of tracks have the truth on top, dashed in ink', () => {
    const lines = trackLines(model, lane('two_step'), 'x2', []);
    expect(lines.map(({ name }) => name)).toEqual(['eavesdropper, window mean', 'eavesdropper, differencing', 'user', 'true']);
    expect(lines.at(-1)).toMatchObject({ signal: 'truth.x2', token: 'ink', dash: [6, 4] });
  });

  it('are keyed once a kind, over all lanes where asked to', () => {
    expect(curveKeys(model, [lane('contamination')], ['fused', 'sent']).map(({ id }) => id)).toEqual(['fused', 'sent']);
    expect(curveKeys(model, model.lanes, ['eve']).map(({ id }) => id)).toEqual(['eve.fusing', 'other.zero', 'eve.differencing', 'other.window_mean']);
    expect(curveKeys(model, model.lanes, ['eve'], false).map(({ id }) => id)).toEqual(['other.zero', 'other.window_mean']);
  });

  it('stay on the picture beyond 1e150, and what is below stays as it is', () => {
    const far = series([1, 1e149, 1e200, Infinity, NaN]);
    expect([...clipped(far).hi]).toEqual([1, 1e149, mostDrawn, mostDrawn, NaN]);
    const near = series([1, 2]);
    expect(clipped(near).lo).toBe(near.lo);
  });
});

describe('the confidentiality index', () => {
  it('has five ranks; what is negative is low', () => {
    expect([-3, 0.93, 1, 1.98, 2, 3.66, 4, 7.99, 8, Infinity].map(rankOf)).toEqual([0, 0, 1, 1, 2, 2, 3, 3, 4, 4]);
  });

  const source = (values: Record<string, number>) => ({ near: (name: string) => series(name in values ? [values[name]!] : []) });
  it('is of covariances where there are any, else of errors, and says which', () => {
    const readings = readingsAt(model, source({ 'lane.two_step.ci': 4.81, 'lane.two_step.rank': 3, 'lane.two_step.eve.window_mean.ci': 0.93, 'lane.unprotected.ci': NaN, 'lane.unprotected.ci_mse': -0.25 }), 0);
    expect(readings.map(({ main }) => main)).toEqual([{ value: -0.25, measure: 'errors' }, { value: 4.81, measure: 'covariance' }, null, null]);
    expect(readings[1]).toMatchObject({ rank: 3, variant: 'differencing', others: [{ variant: 'window_mean', reading: { value: 0.93 } }] });
    expect(gaugeScale(readings)).toEqual({ lo: -1, hi: 16 });
  });

  it('has a scale that holds negative and large values', () => {
    const of = (value: number) => ({ ...readingsAt(model, source({ 'lane.unprotected.ci': value }), 0)[0]! });
    expect(gaugeScale([of(-3.4)]).lo).toBe(-4);
    expect(gaugeScale([of(19.6)]).hi).toBe(21);
    expect(gaugeScale([])).toEqual({ lo: -1, hi: 16 });
    // Every rank is a fifth of the width, whatever it spans.
    expect([-4, 1, 2, 3, 4, 8, 16, 99, -99].map((index) => gaugePlace({ lo: -4, hi: 16 }, index))).toEqual([0, 0.2, 0.4, 0.5, 0.6, 0.8, 1, 1, 0]);
  });

  it('is printed by the paper for its own plant only', () => {
    expect(model.lanes.map(({ id }) => paperIndex(run, id))).toEqual([null, 'infinite', 1.23, 3.66]);
    const other = { ...run, scenario: 'privacy-turn' };
    expect(paperIndex(other, 'two_step')).toBeNull();
    const codeL = { ...run, document: { ...run.document, lanes: { code: { protection: { type: 'secrecy_code', params: { code: 'L' } } } } } };
    expect(paperIndex(codeL, 'code')).toBeNull();
    expect([isFitted(run, 'secrecy_code_a'), isFitted(codeL, 'code'), isFitted(run, 'two_step')]).toEqual([true, false, false]);
  });
});

describe('what the indices say', () => {
  const design = designOf(run, 'two_step');
  const facts = (ci: number, window: number | null, more: Partial<LaneFacts> = {}): LaneFacts => ({
    reading: { lane: lane('two_step'), main: { value: ci, measure: 'covariance' }, rank: rankOf(ci), variant: 'differencing', others: window === null ? [] : [{ variant: 'window_mean', reading: { value: window, measure: 'covariance' } }] },
    design, paper: 'infinite', ...more,
  });

  it('has the slope beside the index, and the window mean’s rank beside the claim', () => {
    const sentences = sentencesOf([facts(4.81, 0.93)]);
    expect(sentences.map(({ key, tone }) => [key, tone])).toEqual([['grows', undefined], ['window_mean_paper', 'bad']]);
    expect(sentences[0]!.values).toMatchObject({ slope: '0.00340', leak: '0.00850', ci: '4.81' });
    expect(sentences[1]!.words).toEqual({ rank: 'rank_low' });
    const text = t('window_mean_paper', { ...sentences[1]!.values, rank: t('rank_low') });
    expect(text).toContain('an index of 0.930, rank low');
  });

  it('says what this run finds: another rank, no growth, a negative index', () => {
    expect(sentencesOf([facts(4.81, 3, { design: { ...design!, slope: 0 } })]).map(({ key, tone }) => [key, tone])).toEqual([['grows_not', 'bad'], ['window_mean_paper', undefined]]);
    expect(sentencesOf([facts(-0.5, null, { design: null, paper: 1.23 })]).map(({ key }) => key)).toEqual(['printed_index', 'negative']);
    expect(sentencesOf([facts(3.66, null, { design: null, paper: 3.66, fitted: true })]).map(({ key }) => key)).toEqual(['printed_fitted']);
    expect(sentencesOf([facts(1, 0.5, { design: null, paper: null })]).map(({ key }) => key)).toEqual(['window_mean']);
  });
});

describe('a design', () => {
  it('is read as it is; an infinite mu is one', () => {
    const design = designOf(run, 'two_step')!;
    expect(design.views.map(({ name, node, mu }) => [name, node, mu])).toEqual([['single', '1', 0.345], ['single', '2', 0.441], ['stream', '1', 1.131], ['stream', '2', Infinity]]);
    expect(design.releases).toEqual([{ node: '1', component: 'x1', std: 0.2, shift: 0.03 }]);
    expect(design.traceEavesdropper.get('window_mean')).toBe(0.0242);
    expect(designOf(run, 'unprotected')).toBeNull();
    expect(designOf({ design: { a: { gamma: 2, views: [], releases: 3, surfaces: null } } }, 'a')).toMatchObject({ designMu: 0.5, views: [], releases: [], kappa: null, plane: null });
  });

  it('has surfaces only where every number is there', () => {
    const of = (raw: object) => designOf({ design: { a: { surfaces: raw } } }, 'a')!;
    expect(of(surfaces).kappa?.pdfe).toEqual([2.13, 1.097, 0.5805]);
    expect(falls(of(surfaces).plane!.pdfe)).toBe(true);
    expect(falls([[1, 2]])).toBe(false);
    expect([indexOf([1, 2, 4], 2), indexOf([1, 4, 16], 2), indexOf([1, 2, 4], 5), indexOf([1], 1), indexOf([], 1)]).toEqual([1, 0.5, null, 0, null]);
    expect(of({ kappa: { ...surfaces.kappa, cdfe: [1] } }).kappa).toBeNull();
    expect(of({ epsilon_delta: { ...surfaces.epsilon_delta, pdfe: [[1]] } }).plane).toBeNull();
  });
});

describe('the guarantee', () => {
  it('has two verdicts for every observer: mu and the exact law', () => {
    const rows = rowsOf(designOf(run, 'two_step')!, model, 'two_step');
    expect(rows.map(({ withinMu, withinDp }) => [withinMu, withinDp])).toEqual([[true, true], [true, true], [false, false], [false, false]]);
    expect(rows[0]!.signal).toBe('lane.two_step.1.loss.single');
    // mu beyond the design value, and (epsilon, delta) holds all the same: the slack of gamma.
    const slack: RunDetail['design'] = { a: { ...twoStep, views: { diff: { 2: { mu: 0.615, p_loss: 0.203, eps_at_delta: 0.456 } } } } };
    expect(rowsOf(designOf({ design: slack }, 'a')!, model, 'a')[0]).toMatchObject({ withinMu: false, withinDp: true, signal: null });
    expect(guaranteedLanes(run, model.lanes).map(({ id }) => id)).toEqual(['two_step']);
  });

  it('counts the losses beyond epsilon, leaving out what is missing', () => {
    const share = sampledShare([NaN, 1, 0.2, NaN, 0.9, 0.1], Math.LN2)!;
    expect([share.hits, share.n, share.share]).toEqual([2, 4, 0.5]);
    expect(sampledShare([], 1)).toBeNull();
    expect(sampledShare([1], null)).toBeNull();
  });

  it('has Wilson’s interval', () => {
    const { lo, hi } = wilson(10, 100)!;
    expect([lo, hi].map((value) => Number(value.toFixed(4)))).toEqual([0.0552, 0.1744]);
    expect(wilson(0, 20)!.lo).toBe(0);
    expect(wilson(20, 20)!.hi).toBe(1);
  });

  it('counts ticks that share noise as fewer: the interval is as wide as their correlation asks', () => {
    // Every loss ten times in a row: a tenth as many independent ones.
    const noise = (i: number): number => ((Math.imul(i + 1, 0x9e3779b1) >>> 8) % 1000) / 1000;
    const apart = Array.from({ length: 2000 }, (_, i) => noise(i));
    const together = Array.from({ length: 2000 }, (_, i) => noise(Math.floor(i / 10)));
    expect(independent(apart)).toBeGreaterThan(1000);
    expect(independent(together)).toBeGreaterThan(100);
    expect(independent(together)).toBeLessThan(400);
    const [a, b] = [sampledShare(apart, 0.5)!, sampledShare(together, 0.5)!];
    expect(b.hi - b.lo).toBeGreaterThan(2 * (a.hi - a.lo));
    expect(independent([1, 1, 1])).toBe(1);
    expect(independent([2])).toBe(1);
    expect(independent([])).toBe(0);
  });

  it('has words for its observers, and the name itself for others', () => {
    expect(viewWord('diff')).toBe('difference of two messages');
    expect(viewWord('some_other')).toBe('some other');
  });
});

describe('words', () => {
  it('exist in Chinese', () => {
    language.set('zh');
    expect(t('window_mean_paper', { lane: 'a', ci: '0.93', rank: t('rank_low') })).toContain('等级“低”');
    expect(t('index')).toBe('保密性');
    language.set('en');
  });
});
