import { describe, expect, it } from 'vitest';
import type { Series } from '../../../data/series';
import { laneOf, makeModel } from '../model';
import { run, signals } from './fixture';
import { contaminatedOf, linksOf } from './messages';
import { normalDensity } from './normal';
import { sceneOf } from './releases_draw';
import { boxOf, type Path } from './tracks_draw';

const model = makeModel(run, signals);
const lane = (id: string) => laneOf(model, id)!;
const series = (values: number[]): Series => {
  const lo = Float64Array.from(values);
  return { k: Float64Array.from(values, (_, i) => i), lo, hi: lo, joined: Uint8Array.from(values, (_, i) => (i ? 1 : 0)) };
};

describe('densities', () => {
  it('of two neighbours lie in one picture that holds both peaks', () => {
    const scene = sceneOf([{ mean: 0, deviation: 1, token: 'a', dash: [], word: '' }, { mean: 3, deviation: 1, token: 'b', dash: [], word: '' }], [], null, 'a');
    expect([scene.from, scene.to]).toEqual([-3.6, 6.6]);
    expect(scene.most).toBeGreaterThan(normalDensity(0, 0, 1));
    expect(scene.histogram).toBeNull();
  });

  it('hold every sample and the bound', () => {
    const scene = sceneOf([{ mean: 0.1, deviation: 0.4, token: 'a', dash: [], word: '' }], [-4, 0, 0.1, 0.2], { at: 5, word: 'ε' }, 'a');
    expect([scene.from, scene.to]).toEqual([-4, 5]);
    const { density, width } = scene.histogram!;
    expect([...density].reduce((sum, value) => sum + value * width, 0)).toBeCloseTo(1, 12);
  });
});

describe('messages', () => {
  it('are the links to the centre, and the components that their sender contaminates', () => {
    expect(linksOf(model)).toEqual(['1', '2'].map((from) => ({ id: `${from}-fused`, from, to: 'fused', state: `link.${from}-fused.state`, overheard: `link.${from}-fused.overheard` })));
    expect(contaminatedOf(model, lane('contamination')).map(({ node, component }) => `${node} ${component}`)).toEqual(['1 x1', '1 x2', '2 x1', '2 x2']);
    expect(contaminatedOf(model, lane('two_step'))).toEqual([]);
  });
});

describe('paths in the plane', () => {
  const look = { token: 'ink', dash: [], width: 1 };
  const path = (x: number[], y: number[], held: boolean): Path => ({ x: series(x), y: series(y), look, held });

  it('hold the true and the user’s, and of one who listens what is near', () => {
    const box = boxOf([path([0, 10], [0, 10], true), path([-5, 4], [2, 3], false)], 1)!;
    expect(box).toEqual({ x0: -5.5, x1: 10.5, y0: -0.5, y1: 10.5 });
    expect(boxOf([path([0, 10], [0, 10], true), path([-1e9, 1e9], [0, 0], false)], 1)).toMatchObject({ x0: -10.5, x1: 20.5 });
    expect(boxOf([path([NaN], [NaN], true)], 1)).toBeNull();
  });
});
