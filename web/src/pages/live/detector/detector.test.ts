import { describe, expect, it } from 'vitest';
import type { RunDetail, Signal } from '../../../api/types';
import type { Series } from '../../../data/series';
import { makeModel } from '../model';
import { attackState, aboutDetectors, detectorOf, detectorsOf, sharedState } from './detectors';
import { layoutOf, scaleOf } from './detector_draw';
import { crossingsOf, stretchesOf, type Stretch } from './strip';

const names = [
  'truth.x1', 'sensor.1.state',
  ...['a', 'b'].flatMap((lane) => [`lane.${lane}.1.statistic`, `lane.${lane}.1.threshold`, `lane.${lane}.1.alarm`]),
  'lane.a.sensor.1.state', 'lane.plain.1.estimate.x1', 'lane.half.1.statistic', 'lane.half.1.alarm',
];
const signals = names.map((name, id): Signal => {
  const [, lane, node] = name.startsWith('lane.') ? name.split('.') : [];
  return { id, name, unit: '', kind: 'scalar', lane: lane ?? null, node: node === 'sensor' ? '1' : (node ?? null) };
});
const run = {
  family: 'replay', view: { lane: 'b', detector: true },
  world: { nodes: [{ id: '1', position: null }], links: [], lanes: ['plain', 'a', 'b', 'half'].map((id) => ({ id, method: 'm', adversary: id !== 'b' })), state: [] },
} as unknown as RunDetail;
const model = makeModel(run, signals);

/** One point a tick from `first` on; '.': missing. */
function raw(text: string, first = 1): Series {
  const lo = Float64Array.from(text, (c) => (c === '.' ? NaN : Number(c)));
  return { k: Float64Array.from(text, (_, i) => first + i), lo, hi: lo, joined: Uint8Array.from(text, (_, i) => (i ? 1 : 0)) };
}
const short = (stretches: readonly Stretch[]): string[] => stretches.map(({ from, to, sign }) => `${sign} ${from}-${to}`);
const counting = { from: 3, tail: 2 };

describe('detectors', () => {
  it('are the lanes that have a statistic, a threshold and an alarm', () => {
    expect(detectorsOf(model, null).map(({ lane, node }) => [lane.id, node])).toEqual([['a', '1'], ['b', '1']]);
  });

  it('know when what they read is attacked: by their own sensor, else by the shared one, a spared lane never', () => {
    expect(detectorsOf(model, null).map(({ state }) => state)).toEqual(['lane.a.sensor.1.state', null]);
    const known = new Set(names);
    expect(attackState(known, model.lanes.find((lane) => lane.id === 'plain')!, '1')).toBe('sensor.1.state');
    expect(sharedState(model, detectorsOf(model, null))).toBe('sensor.1.state');
  });

  it('over all sensors are judged by the state of the chosen node, or of the first that has one', () => {
    const fused = ['sensor.1.state', 'sensor.2.state', ...['statistic', 'threshold', 'alarm'].map((kind) => `lane.all.fused.${kind}`)].map(
      (name, id): Signal => ({ id, name, unit: '', kind: 'scalar', lane: name.startsWith('lane.') ? 'all' : null, node: name.startsWith('lane.') ? 'fused' : name.slice(7, 8) }),
    );
    const nodes = ['1', '2'].map((id) => ({ id, position: null }));
    const over = (adversary: boolean) => makeModel({ ...run, view: {}, world: { nodes, links: [], lanes: [{ id: 'all', method: 'm', adversary }], state: [] } } as unknown as RunDetail, fused);
    expect(detectorsOf(over(true), null).map(({ node, state }) => [node, state])).toEqual([['fused', 'sensor.1.state']]);
    expect(detectorsOf(over(true), '2').map(({ state }) => state)).toEqual(['sensor.2.state']);
    expect(detectorsOf(over(false), null).map(({ state }) => state)).toEqual([null]);
  });

  it('fall back to the lane that the scenario leads with', () => {
    expect(detectorOf(model, 'a', null)?.lane.id).toBe('a');
    expect(detectorOf(model, 'plain', null)?.lane.id).toBe('b');
    expect(detectorOf(makeModel(run, signals.slice(0, 2)), 'a', null)).toBeNull();
  });

  it('are what a run is about by its family or its view', () => {
    expect([run, { family: 'own', view: { detector: true } }, { family: 'sparse', view: {} }].map((one) => aboutDetectors(one as RunDetail))).toEqual([true, true, false]);
  });
});

describe('the alarm strip', () => {
  it('tells hits, misses, false alarms, what does not count, and what cannot be said', () => {
    const alarm = raw('..01010011101');
    const state = raw('0000003330000');
    // Flags at 4, 6, 9, 10, 11, 13; attacked 7 to 9; the tail is 10 and 11.
    expect(short(stretchesOf(alarm, state, counting))).toEqual(['unknown 1-2', 'false 4-4', 'false 6-6', 'miss 7-8', 'hit 9-9', 'uncounted 10-11', 'false 13-13']);
  });

  it('does not count flags before the first tick that may be false', () => {
    expect(short(stretchesOf(raw('1111'), raw('0000'), counting))).toEqual(['uncounted 1-2', 'false 3-4']);
  });

  it('of a lane that is never attacked has no hits', () => {
    expect(short(stretchesOf(raw('0011'), null, counting))).toEqual(['false 3-4']);
  });

  it('gives a thinned frame all its ticks, and breaks at missing ones', () => {
    const v = Float64Array.of(0, 1, 1);
    const thinned: Series = { k: Float64Array.of(1, 5, 9), lo: v, hi: v, joined: Uint8Array.of(0, 1, 0) };
    const s = Float64Array.of(3, 3, 3);
    expect(short(stretchesOf(thinned, { ...thinned, lo: s, hi: s }, counting))).toEqual(['miss 1-1', 'hit 2-5', 'hit 9-9']);
  });

  it('takes the greatest of reduced samples up to the next point', () => {
    const reduced: Series = { k: Float64Array.of(0, 10, 20), lo: Float64Array.of(0, 0, 0), hi: Float64Array.of(0, 1, 0), joined: Uint8Array.of(0, 1, 1) };
    const calm: Series = { ...reduced, hi: Float64Array.of(0, 0, 0) };
    expect(short(stretchesOf(reduced, calm, counting))).toEqual(['false 10-19']);
  });
});

describe('crossings', () => {
  it('are where a flag rises, and where it is lost while the attack goes on', () => {
    const found = crossingsOf(stretchesOf(raw('0001001101100'), raw('0000033333300'), counting));
    expect(found).toEqual([
      { k: 4, kind: 'false' },
      { k: 7, kind: 'hit' },
      { k: 9, kind: 'lost' },
      { k: 10, kind: 'hit' },
    ]);
  });

  it('do not rise again where a flag was up already', () => {
    // A false alarm that goes on into the attack, and a hit that goes on after it.
    expect(crossingsOf(stretchesOf(raw('0001111111'), raw('0000330000'), counting)).map(({ k }) => k)).toEqual([4]);
  });
});

describe('the picture', () => {
  const g = { width: 800, height: 418, left: 100, right: 8, top: 4, bottom: 18, from: 0, to: 100 };

  it('keeps at least half of its height for the chart, and never loses a row', () => {
    const { chart, rows } = layoutOf(g, 14);
    expect(rows).toHaveLength(14);
    expect(rows.at(-1)!.y + rows.at(-1)!.height).toBe(g.height - g.bottom);
    expect(chart.height - chart.bottom).toBeLessThanOrEqual(rows[0]!.y);
    expect(chart.height - chart.bottom - chart.top).toBeGreaterThan(0.4 * g.height);
    expect(layoutOf(g, 0).chart.bottom).toBe(g.bottom);
    expect(layoutOf({ ...g, height: 120 }, 15).rows.every(({ height }) => height >= 5)).toBe(true);
  });

  it('has a linear scale where nothing is above zero', () => {
    const line = (series: Series): Parameters<typeof scaleOf>[0] => [{ series, token: 'ink', width: 1, dash: [] }];
    expect(scaleOf(line(raw('0000')), g, true).log).toBe(false);
    expect(scaleOf(line(raw('0123')), g, true).log).toBe(true);
    expect(scaleOf(line(raw('0123')), g, false)).toMatchObject({ log: false, lo: 0 });
  });
});
