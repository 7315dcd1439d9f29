import { describe, expect, it } from 'vitest';
import type { RunDetail } from '../../../api/types';
import { closeDifference, magnitude, type Series } from '../../../data/series';
import { language } from '../../../i18n/i18n.svelte';
import { laneOf, makeModel } from '../model';
import { panelsOf } from '../panels';
import { nodeMetric, rmsOf, sizeOf, windowOf } from './figures';
import { metric, record, run, signals } from './fixture';
import { kindOf } from './kinds';
import { channelErrorLines, channelLines, signalsOf, stateErrorLines } from './lines';
import { leaving, places } from './network_draw';
import { poleScales } from './poles_draw';
import { recordOf } from './record';
import { sentencesOf, type Sentence } from './sentences';
import { couplingsOf, hasSubsystems, settledTick, subsystemsOf } from './subsystems';
import { t } from './words';

const model = makeModel(run, signals);
const subsystems = subsystemsOf(model);
const fast = laneOf(model, 'intermediate_fast')!;
const drawn = { lanes: model.lanes, chosen: fast, streamed: fast, truthWord: 'true' };

function series(lo: number[], hi: number[] = lo, k = [...lo.keys()]): Series {
  const low = Float64Array.from(lo);
  return { k: Float64Array.from(k), lo: low, hi: lo === hi ? low : Float64Array.from(hi), joined: Uint8Array.from(lo, (_, i) => (i ? 1 : 0)) };
}

describe('subsystems', () => {
  it('are told by their signals: sizes, own states, attack and fault channels with their truth', () => {
    expect(subsystems.map(({ id, states, sizes }) => [id, states, sizes])).toEqual([
      ['1', ['x1_1', 'x1_2'], { n: 2, p: 2, q: 1, g: 1, dd: 1 }],
      ['2', ['x2_1'], { n: 1, p: 2, q: 1, g: 1, dd: 1 }],
    ]);
    expect(subsystems[1]!.channels).toEqual([
      { kind: 'attack', name: 'w1', truth: 'actuator.2.w1.injected' },
      { kind: 'fault', name: 'f1', truth: 'fault.2.f1' },
    ]);
  });

  it('bring their panels, whatever the family is called, and no panel of sensors or plain errors', () => {
    const names = panelsOf({ ...run, family: 'other' }, model).map(({ name }) => name);
    expect(names).toEqual(['state-errors', 'attack-fault', 'methods', 'subsystems', 'design', 'events', 'attacks']);
    const consensus = makeModel(run, signals.filter(({ name }) => !/estimate|attack|fault/.test(name)));
    expect(hasSubsystems(consensus)).toBe(false);
  });

  it('are coupled as the document says, else as the examples are', () => {
    const ids = ['1', '2', '3', '4'];
    const of = (plant: object, links: RunDetail['world']['links'] = []) => couplingsOf({ document: { plant } as RunDetail['document'], world: { ...run.world, links } }, ids).map(({ from, to }) => `${from}${to}`);
    expect(of({ type: 'interconnected', params: { couplings: { '2-1': [[1]], '3-4': [[1]] } } })).toEqual(['21', '34']);
    expect(of({ type: 'areas', params: {} })).toHaveLength(12);
    expect(of({ type: 'areas', params: { topology: 'ring' } })).toEqual(['12', '14', '21', '23', '32', '34', '41', '43']);
    expect(of({ type: 'interconnected', params: { couplings: {} } })).toEqual([]);
  });

  it('peak in the first half second, which does not count for the scales', () => {
    expect(settledTick(run)).toBe(500);
  });
});

describe('lines', () => {
  it('of state errors are one an own state, estimate minus truth', () => {
    expect(stateErrorLines(model, fast, subsystems[0]!).map(({ signal, minus, close }) => [signal, minus, close])).toEqual([
      ['lane.intermediate_fast.1.estimate.x1_1', 'truth.x1_1', true],
      ['lane.intermediate_fast.1.estimate.x1_2', 'truth.x1_2', true],
    ]);
  });

  it('take a truth of the lane’s own where it has one', () => {
    const own = makeModel(run, [...signals, { id: 99, name: 'lane.intermediate_fast.truth.x2_1', unit: '', kind: 'scalar', lane: 'intermediate_fast' }]);
    expect(stateErrorLines(own, laneOf(own, 'intermediate_fast')!, subsystems[1]!)[0]!.minus).toBe('lane.intermediate_fast.truth.x2_1');
  });

  it('of a channel are every lane’s and the truth on top, dashed in ink; the errors have no truth', () => {
    const channel = subsystems[0]!.channels[0]!;
    const lines = channelLines(model, '1', channel, drawn);
    expect(lines.map(({ name, token, strong }) => [name, token, strong ?? false])).toEqual([['intermediate fast', 'lane-0', true], ['intermediate printed', 'lane-1', false], ['true', 'ink', false]]);
    expect(lines[1]!.unstreamed).toBe(true);
    expect(signalsOf(channelErrorLines(model, '1', channel, drawn))).toEqual(['lane.intermediate_fast.1.attack.w1', 'actuator.1.w1.injected', 'lane.intermediate_printed.1.attack.w1']);
    expect(channelErrorLines(model, '1', { ...channel, truth: null }, drawn)).toEqual([]);
  });
});

describe('errors of two signals that move together', () => {
  it('stay within the true error’s range in reduced samples, where the widest range would not', () => {
    // One point stands for a full swing of both; the estimate is 0.01 too high.
    const difference = closeDifference(series([-0.99, -0.99], [1.01, 1.01]), series([-1, -1], [1, 1]));
    for (const v of [...difference.lo, ...difference.hi]) expect(v).toBeCloseTo(0.01, 6);
  });

  it('have a size', () => {
    expect([...magnitude(series([-3, 1], [2, 4])).hi]).toEqual([3, 4]);
    expect(magnitude(series([-10, 0])).hi[1]).toBeCloseTo(1e-4, 9);
    expect(magnitude(series([1, NaN])).hi[1]).toBeNaN();
  });
});

describe('figures', () => {
  it('are the run’s own, over the window that the scenario names', () => {
    expect(nodeMetric(run.metrics, 'intermediate_printed', '2', 'rms_attack_error')).toBe(0.801);
    expect(nodeMetric(run.metrics, 'intermediate_printed', '3', 'rms_attack_error')).toBeNull();
    expect(windowOf(run)).toEqual({ from: 8000, to: 20000, seconds: [8, 20] });
    expect(windowOf({ ...run, document: { time: { steps: 100 } } })).toEqual({ from: 0, to: 100, seconds: [0, 0.1] });
  });

  it('beside the size of what was to be found: a sine over whole periods has 0.707', () => {
    const k = Array.from({ length: 1001 }, (_, i) => i);
    const sine = series(k.map((i) => Math.sin((2 * Math.PI * i) / 100)), undefined, k);
    expect(rmsOf(sine, 0, 1000)).toBeCloseTo(Math.SQRT1_2, 6);
    // Ten ticks a point change little.
    const reduced = series(k.slice(0, 100).map((i) => Math.sin((2 * Math.PI * i) / 10)), k.slice(0, 100).map((i) => Math.sin((2 * Math.PI * (i + 1)) / 10)), k.slice(0, 100));
    expect(rmsOf(reduced, -1, 99)).toBeGreaterThan(0.65);
    expect(rmsOf(sine, 2000, 3000)).toBeNull();
    expect(sizeOf(subsystems[0]!, 'attack', new Map([['actuator.1.w1.injected', 0.707]]))).toBe(0.707);
    expect(sizeOf(subsystems[0]!, 'attack', new Map())).toBeNull();
  });
});

describe('a design', () => {
  it('is read as it is, with what is missing kept in its place', () => {
    const read = recordOf(run, 'intermediate_fast')!;
    expect(read.gammaD[0]).toBe(0.033);
    expect(read.gammaD[1]).toBeNaN();
    expect(read.poles).toEqual([{ re: -0.61, im: 0 }, { re: -30, im: 12 }, { re: -30, im: -12 }]);
    expect(read.gains).toEqual([[[1, 2], [3, 4]], [[5], [6]]]);
    expect(recordOf(run, 'other')).toBeNull();
    expect(recordOf({ design: { a: { Q: [[1]] } } }, 'a')).toBeNull();
  });

  it('has its poles in a plane that always shows the imaginary axis', () => {
    const { re, im } = poleScales([{ re: -0.61, im: 0 }, { re: -997, im: 120 }], true);
    expect(re.lo).toBeLessThan(-997);
    expect(re.hi).toBeGreaterThanOrEqual(0);
    expect(im.lo).toBe(-im.hi);
    expect(poleScales([{ re: -2, im: 0 }], false).im.hi).toBeGreaterThan(0);
  });
});

describe('the picture of the network', () => {
  it('keeps every box inside, and arrows between their edges', () => {
    for (const count of [1, 2, 3, 4, 8]) {
      const at = places(count, 380, 190);
      expect(at).toHaveLength(count);
      for (const { x, y } of at) {
        expect(x).toBeGreaterThan(38);
        expect(x).toBeLessThan(342);
        expect(y).toBeGreaterThan(17);
        expect(y).toBeLessThan(173);
      }
    }
    expect(leaving({ x: 0, y: 0 }, { x: 200, y: 0 })).toEqual({ x: 43, y: 0 });
  });
});

const say = (values: Record<string, string>): string => t('miss', values);
const keys = (sentences: readonly Sentence[]): string[] => sentences.map(({ key }) => key);

describe('what the comparison says', () => {
  const sizes = new Map([['actuator.1.w1.injected', 0.707], ['actuator.2.w1.injected', 0.707]]);
  const facts = { run, lanes: model.lanes.map(({ id }) => id), subsystems, sizes };

  it('of the printed gains: stable and certified, and yet they miss the attacks, with this run’s numbers', () => {
    language.set('en');
    expect(keys(sentencesOf(facts, say))).toEqual(['printed_certified', 'printed_misses', 'printed_why', 'proposed_follows']);
    const text = sentencesOf(facts, say).map(({ key, values }) => t(key, values)).join(' ');
    expect(text).toContain('their slowest pole at -0.533');
    expect(text).toContain('subsystem 1: 0.698 of an attack of 0.707');
  });

  it('of the printed gains, whatever this run finds: nothing is taken for granted', () => {
    const good = { ...run, metrics: [metric('intermediate_printed', '1', 'rms_attack_error', 0.01)] };
    expect(keys(sentencesOf({ ...facts, run: good }, say))).toEqual(['printed_certified', 'printed_numbers']);
    const bare = { ...run, design: { intermediate_printed: { ...record, solver: 'given', holds: false, reason: 'none was found' } }, metrics: [] };
    expect(keys(sentencesOf({ ...facts, run: bare }, say))).toEqual(['printed_uncertified']);
    const unstable = { ...bare, design: { intermediate_printed: { ...record, max_real_pole: 0.2 } } };
    expect(keys(sentencesOf({ ...facts, run: unstable }, say))).toEqual(['printed_unstable']);
  });

  const areas = (attacks: [number, number], errors: [number, number], matched: [boolean, boolean] = [true, false]) => {
    const document = { ...run.document, lanes: { matched_uio: { method: 'matched_observer', params: {} } } };
    const metrics = [metric('matched_uio', '1', 'rms_attack_error', errors[0]), metric('matched_uio', '2', 'rms_attack_error', errors[1])];
    return keys(sentencesOf({ run: { document, metrics, design: { matched_uio: { ...record, matched } } }, lanes: ['matched_uio'], subsystems, sizes: new Map([['actuator.1.w1.injected', attacks[0]], ['actuator.2.w1.injected', attacks[1]]]) }, say));
  };

  it('of figure 7: only an attack where the condition is violated shows what it says', () => {
    expect(areas([0.08, 0], [0.0014, 0])).toEqual(['matching_fails', 'figure7_not_shown']);
    expect(areas([0.08, 0], [0.09, 0])).toEqual(['matching_fails', 'figure7_unattacked']);
    expect(areas([0.08, 0.72], [0.11, 0.72])).toEqual(['matching_fails', 'figure7_shown']);
    expect(areas([0.08, 0.72], [0.11, 0.1])).toEqual(['matching_fails', 'figure7_attacked']);
    expect(areas([0.08, 0], [0.0014, 0], [true, true])).toEqual(['matching_holds', 'figure5_shown']);
    expect(areas([0, 0], [0, 0])).toEqual(['matching_fails']);
  });

  it('of figure 8: lanes of the same bounds are compared, whoever is better', () => {
    const lanes = {
      mine: { method: 'intermediate_observer', params: { structure: 'proposed', preset: 'ref' } },
      theirs: { method: 'intermediate_observer', params: { structure: 'classical', preset: 'ref' } },
      high: { method: 'intermediate_observer', params: { structure: 'classical', preset: 'fast' } },
    };
    const compare = (mine: number, theirs: number) => {
      const metrics = [metric('mine', '1', 'rms_attack_error', mine), metric('theirs', '1', 'rms_attack_error', theirs), metric('high', '1', 'rms_attack_error', 1)];
      return sentencesOf({ run: { document: { lanes }, metrics, design: {} }, lanes: Object.keys(lanes), subsystems, sizes: new Map([['actuator.1.w1.injected', 0.66]]) }, say);
    };
    const better = compare(0.0817, 0.2263);
    expect(keys(better)).toEqual(['proposed_follows', 'classical_worse', 'classical_why']);
    expect(better[1]!.values!.share).toBe(64);
    expect(keys(compare(0.65, 0.151))).toEqual(['proposed_misses', 'classical_better', 'classical_why']);
  });

  it('of a lane that lets the disturbance through', () => {
    const leaky = { ...run, design: { intermediate_fast: { ...record, gamma_d: [4.7, 0.16] } }, metrics: [metric('intermediate_fast', '1', 'rms_attack_error', 0.718)] };
    expect(keys(sentencesOf({ ...facts, run: leaky, lanes: ['intermediate_fast'] }, say))).toEqual(['proposed_leaks']);
  });

  it('tells kinds of lanes by what they are set to', () => {
    expect(['intermediate_fast', 'intermediate_printed', 'none'].map((lane) => kindOf(run, lane))).toEqual(['proposed', 'printed', 'other']);
  });
});

describe('words', () => {
  it('exist in Chinese for every sentence', () => {
    language.set('zh');
    expect(t('figure7_shown', { lane: 'a', no: '2', numbers: '' })).toContain('图 7');
    language.set('en');
  });
});
