import { describe, expect, it } from 'vitest';
import type { Metric, RunDetail, Signal } from '../../../api/types';
import type { Series } from '../../../data/series';
import { makeModel } from '../model';
import { reconstructionOf, wrap } from './channels';
import { percent, qualityOf } from './quality';
import { stripBoxes, stripScale } from './strip_draw';
import { tally, verdictOf, wrapSeries } from './tally';

function series(k: number[], lo: number[], hi?: number[]): Series {
  const low = Float64Array.from(lo);
  return { k: Float64Array.from(k), lo: low, hi: hi ? Float64Array.from(hi) : low, joined: new Uint8Array(k.length).fill(1) };
}

describe('a reconstructed entry', () => {
  it('is a hit, a miss or false; zero against zero is none of them', () => {
    expect([verdictOf(2, 1.9), verdictOf(2, 0), verdictOf(0, -1e-5), verdictOf(0, 0), verdictOf(-1, 3)]).toEqual(['hit', 'miss', 'false', null, 'hit']);
  });

  it('is counted inside the window, where both sides are known', () => {
    const truth = series([4, 5, 6, 7, 8, 10], [9, 1, 2, 0, 0, 3]);
    const found = series([5, 6, 7, 8, 9, 10], [1.1, 0, 4, 0, 5, NaN]);
    const result = tally(truth, found, 5, 10);
    expect(result).toMatchObject({ hits: 1, misses: 1, falses: 1, known: 4, exact: true });
    expect(result.entries.map(({ k, verdict }) => [k, verdict])).toEqual([
      [5, 'hit'],
      [6, 'miss'],
      [7, 'false'],
    ]);
    expect(tally(truth, found, 6, 6)).toMatchObject({ hits: 0, misses: 1, falses: 0, known: 1 });
  });

  it('is not judged where samples are reduced, nor without a truth', () => {
    expect(tally(series([0, 10], [0, 0], [1, 1]), series([0, 10], [0, 1]), 0, 10)).toMatchObject({ exact: false, known: 0, entries: [] });
    expect(tally(series([], []), series([0, 1], [1, 1]), 0, 1)).toMatchObject({ exact: true, known: 0, hits: 0, falses: 0 });
  });

  it('of an angle is compared modulo a turn', () => {
    expect(wrap(1.5 * Math.PI, 2 * Math.PI)).toBeCloseTo(-0.5 * Math.PI);
    expect(wrap(-Math.PI, 2 * Math.PI)).toBeCloseTo(Math.PI);
    expect(wrap(Math.PI, 2 * Math.PI)).toBeCloseTo(Math.PI);
    expect(wrap(7, 0)).toBe(7);
    const [entry] = tally(series([1], [6]), series([1], [-0.28]), 1, 1, 2 * Math.PI).entries;
    expect(entry!.verdict).toBe('hit');
    expect(entry!.injected).toBeCloseTo(6 - 2 * Math.PI, 5);
    const wrapped = wrapSeries(series([0, 1], [0, 6], [1, 6.5]), 2 * Math.PI);
    for (let i = 0; i < 2; i++) expect(wrapped.lo[i]!).toBeLessThanOrEqual(wrapped.hi[i]!);
  });
});

describe('strips', () => {
  it('share the height without touching, and hold zero', () => {
    const g = { width: 400, height: 222, left: 44, right: 8, top: 4, bottom: 18, from: 0, to: 10 };
    const boxes = stripBoxes(g, 6);
    boxes.slice(1).forEach((box, i) => expect(box.y).toBeGreaterThan(boxes[i]!.y + boxes[i]!.height));
    expect(boxes.at(-1)!.y + boxes.at(-1)!.height).toBeLessThan(g.height - g.bottom);
    const strip = (injected: number[], found: number[]) => ({ injected: series([0, 1], injected), found: series([0, 1], found), tally: tally(series([], []), series([], []), 0, 1) });
    const scale = stripScale(strip([12, 14], [11, 13]), 0, 1)!;
    expect(scale.lo).toBeLessThanOrEqual(0);
    expect(scale.hi).toBeGreaterThanOrEqual(14);
    expect(stripScale(strip([0, 0], [0, 0]), 0, 1)).toBeNull();
  });
});

describe('what a lane reconstructs', () => {
  const names = ['sensor.1.range.injected', 'sensor.1.azimuth.injected', 'lane.ekf.1.error', 'lane.omp.1.attack.range', 'lane.omp.1.attack.azimuth', 'lane.omp.1.attack.vx'];
  const signals = names.map((name, id): Signal => ({ id, name, unit: name.includes('azimuth') ? 'rad' : 'm', kind: 'scalar', lane: name.startsWith('lane.') ? name.split('.')[1] : null, node: '1' }));
  const run = { view: {}, world: { nodes: [{ id: '1', position: null }], links: [], lanes: ['ekf', 'omp'].map((id) => ({ id, method: '', adversary: true })), state: [] } } as unknown as RunDetail;

  it('is found by channel, with the true attack beside it where it is told', () => {
    const made = reconstructionOf(makeModel(run, signals), 'ekf')!;
    expect(made.lane.id).toBe('omp');
    expect(made.nodes[0]!.channels.map(({ name, injected, period }) => [name, injected, period])).toEqual([
      ['range', 'sensor.1.range.injected', 0],
      ['azimuth', 'sensor.1.azimuth.injected', 2 * Math.PI],
      ['vx', null, 0],
    ]);
    expect(reconstructionOf(makeModel(run, signals.slice(0, 3)), null)).toBeNull();
  });

  it('is as good as the metrics say, by type of attack', () => {
    const metric = (name: string, variant: string | null, value: number | null, lane = 'omp'): Metric => ({ lane, node: null, name, variant, value });
    const metrics = [metric('omp_exact', 'II', 0), metric('omp_exact', 'I', 0.004), metric('omp_hit_rate', 'I', 0.783), metric('omp_false_entries', 'I', 1.96), metric('omp_exact', 'R', null), metric('omp_exact', 'I', 1, 'other'), metric('alarm_rate_clean', null, 0)];
    expect(qualityOf(metrics, 'omp')).toEqual([
      { type: 'I', exact: 0.004, hit: 0.783, falses: 1.96 },
      { type: 'II', exact: 0, hit: NaN, falses: NaN },
    ]);
    expect(qualityOf(metrics, 'ekf')).toEqual([]);
  });

  it('never says none or all where it is not', () => {
    expect([0, 1, 0.783, 0.004, 0.0004, 0.998, 0.9999, NaN].map(percent)).toEqual(['0 %', '100 %', '78 %', '0.4 %', '< 0.1 %', '99.8 %', '> 99.9 %', '–']);
  });
});
