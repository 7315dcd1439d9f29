import { describe, expect, it } from 'vitest';
import type { RunDetail, Signal } from '../../../api/types';
import type { Series } from '../../../data/series';
import { makeModel } from '../model';
import { axesOf, reach } from './ellipse';
import { bandOf, estimatesOf } from './estimates';
import { boxOf, pointAt, type Scene, type Way } from './plane_draw';

function raw(values: readonly number[], first = 0): Series {
  const lo = Float64Array.from(values);
  return { k: Float64Array.from(values, (_, i) => first + i), lo, hi: lo, joined: Uint8Array.from(values, (_, i) => (i ? 1 : 0)) };
}

describe('an ellipse', () => {
  it('has the square roots of the eigenvalues as half axes', () => {
    expect(axesOf({ xx: 9, xy: 0, yy: 4 })).toEqual({ a: 3, b: 2, angle: 0 });
    const turned = axesOf({ xx: 2.5, xy: 1.5, yy: 2.5 })!;
    expect(turned.a).toBeCloseTo(2, 12);
    expect(turned.b).toBeCloseTo(1, 12);
    expect(turned.angle).toBeCloseTo(Math.PI / 4, 12);
    expect(axesOf({ xx: 4, xy: 0, yy: 9 })!.angle).toBeCloseTo(Math.PI / 2, 12);
  });

  it('touches its projections: the farthest point along a component is the root of its diagonal entry', () => {
    const shape = { xx: 0.46, xy: -0.11, yy: 0.71 };
    const { a, b, angle } = axesOf(shape)!;
    const points = Array.from({ length: 7200 }, (_, i) => (i / 7200) * 2 * Math.PI).map((s) => [a * Math.cos(s) * Math.cos(angle) - b * Math.sin(s) * Math.sin(angle), a * Math.cos(s) * Math.sin(angle) + b * Math.sin(s) * Math.cos(angle)] as const);
    expect(Math.max(...points.map(([x]) => x))).toBeCloseTo(reach(shape.xx), 5);
    expect(Math.max(...points.map(([, y]) => y))).toBeCloseTo(reach(shape.yy), 5);
    // Every point is on the boundary: d' M^-1 d = 1.
    const det = shape.xx * shape.yy - shape.xy ** 2;
    for (const [x, y] of points.slice(0, 50)) expect((shape.yy * x * x - 2 * shape.xy * x * y + shape.xx * y * y) / det).toBeCloseTo(1, 9);
  });

  it('grows with the number of standard deviations, may be a point, and is none where the matrix is not one', () => {
    expect(axesOf({ xx: 1, xy: 0, yy: 1 }, 2)).toEqual({ a: 2, b: 2, angle: 0 });
    expect(axesOf({ xx: 0, xy: 0, yy: 0 })).toEqual({ a: 0, b: 0, angle: 0 });
    expect(axesOf({ xx: NaN, xy: 0, yy: 1 })).toBeNull();
    expect(axesOf({ xx: 1, xy: 2, yy: 1 })).toBeNull();
  });
});

describe('the band', () => {
  it('is the root of M, and two roots of Q on top of it', () => {
    const band = bandOf(raw([1, 2, 3]), raw([NaN, 4, 4]), raw([0, 0.25, 1]));
    expect([...band.middle]).toEqual([1, 2, 3]);
    expect([...band.inner]).toEqual([NaN, 2, 2]);
    expect([...band.outer]).toEqual([NaN, 3, 4]);
  });

  it('has no width where nothing is published', () => {
    expect([...bandOf(raw([1, 2]), null, null).outer]).toEqual([0, 0]);
  });

  it('takes the entry that holds at the tick', () => {
    expect([...bandOf(raw([0, 0, 0], 5), raw([1], 5), raw([], 0)).inner]).toEqual([1, 1, 1]);
    expect([...bandOf(raw([0, 0], 5), raw([1], 6), null).inner]).toEqual([NaN, 1]);
  });
});

describe('estimates', () => {
  const names = ['truth.x1', 'truth.x2', 'lane.a.truth.x1', 'lane.a.truth.x2', ...['x1', 'x2'].flatMap((c) => [`lane.a.1.estimate.${c}`, `lane.b.1.estimate.${c}`, `lane.a.1.shape.${c}.${c}`]), 'lane.a.1.shape.x1.x2', 'lane.c.1.estimate.x1'];
  const signals = names.map((name, id): Signal => {
    const [, lane, node] = name.startsWith('lane.') ? name.split('.') : [];
    return { id, name, unit: '', kind: 'scalar', lane: lane ?? null, node: node === '1' ? '1' : null };
  });
  const run = { view: {}, world: { nodes: [{ id: '1', position: null }], links: [], lanes: ['a', 'b', 'c'].map((id) => ({ id, method: '', adversary: true })), state: [{ name: 'x1', unit: '' }, { name: 'x2', unit: '' }] } } as unknown as RunDetail;
  const model = makeModel(run, signals);
  const of = (id: string): ReturnType<typeof estimatesOf> => estimatesOf(run, model, model.lanes.find((lane) => lane.id === id)!, null);

  it('belong to the lane’s own plant where it has one', () => {
    expect(of('a')!.components.map(({ truth }) => truth)).toEqual(['lane.a.truth.x1', 'lane.a.truth.x2']);
    expect(of('b')!.components.map(({ truth }) => truth)).toEqual(['truth.x1', 'truth.x2']);
  });

  it('say which parts of the error the lane publishes', () => {
    expect(of('a')!.components[0]).toMatchObject({ shape: 'lane.a.1.shape.x1.x1', covariance: null });
    expect(of('a')!.cross).toEqual({ shape: 'lane.a.1.shape.x1.x2', covariance: null });
    expect(of('b')!.components[0]!.shape).toBeNull();
  });

  it('need a plane', () => expect(of('c')).toBeNull());
});

describe('the plane', () => {
  const way = (x: readonly number[], y: readonly number[]): Way => ({ x: raw(x), y: raw(y) });
  const scene = (changes: Partial<Scene> = {}): Scene => ({ truth: way([0, 1, 2], [0, 1, 2]), estimate: way([0, 1, 1], [0, 1, 1]), bounded: null, random: null, token: 'lane-0', names: ['x1', 'x2'], at: 2, tail: 40, ...changes });

  it('shows the point at the cursor, and none that is old', () => {
    expect(pointAt(way([1, 2, 3], [4, 5, 6]), 1)).toEqual([2, 5]);
    expect(pointAt(way([1, 2, NaN], [4, 5, 6]), 2)).toEqual([2, 5]);
    expect(pointAt(way([1], [4]), 9)).toBeNull();
  });

  it('holds both ways and the ellipse', () => {
    const box = boxOf(scene({ bounded: { a: 5, b: 1, angle: 0 } }), null)!;
    expect(box.x0).toBeLessThan(-4);
    expect(box.x1).toBeGreaterThan(6);
    expect(boxOf(scene({ truth: way([], []), estimate: way([], []) }), box)).toBe(box);
  });

  it('keeps its box while everything fits, and gives up one that is far too large', () => {
    const box = boxOf(scene(), null);
    expect(boxOf(scene({ estimate: way([0, 1, 1.5], [0, 1, 1.2]) }), box)).toBe(box);
    expect(boxOf(scene({ at: 1 }), box)!.x1).toBeLessThan(1.5);
  });
});
