import { describe, expect, it } from 'vitest';
import type { RunDetail, Signal } from '../../../api/types';
import { nodeLook } from '../../../chart/marks';
import type { Series } from '../../../data/series';
import { makeModel } from '../model';
import { basisOf, dot, dragged, parseTurn, Projection, turned, turnText, usualTurn, type Box, type Point } from './projection';
import { groundOf, spaceBox } from './space_box';
import { lookOf, spaceModel, waysOf } from './space_model';
import { endOf, reaches, readTrack, stateAt, type Track } from './tracks';

const none = { left: 0, right: 0, top: 0, bottom: 0 };
const box: Box = { min: [-10, -10, 0], max: [10, 10, 8] };

function series(k: number[], v: number[]): Series {
  const values = Float64Array.from(v);
  return { k: Float64Array.from(k), lo: values, hi: values, joined: Uint8Array.from(k.map((_, i) => (i ? 1 : 0))) };
}
function track(points: readonly Point[]): Track {
  const axis = (a: 0 | 1 | 2): Float64Array => Float64Array.from(points, (point) => point[a]);
  return { k: Float64Array.from(points.keys()), joined: Uint8Array.from(points, (_, i) => (i ? 1 : 0)), x: axis(0), y: axis(1), z: axis(2), length: points.length };
}

describe('the projection', () => {
  it('has an orthonormal, right-handed basis from everywhere', () => {
    for (const azimuth of [-170, -60, 0, 35, 90, 180]) {
      for (const height of [4, 34, 60, 90]) {
        const { right, up, eye } = basisOf('space', { azimuth, height });
        for (const [a, b, expected] of [[right, right, 1], [up, up, 1], [eye, eye, 1], [right, up, 0], [right, eye, 0], [up, eye, 0]] as const) expect(dot(a, ...b)).toBeCloseTo(expected, 12);
        const cross: Point = [right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2], right[0] * up[1] - right[1] * up[0]];
        expect(dot(cross, ...eye)).toBeCloseTo(1, 12);
        expect(up[2]).toBeGreaterThanOrEqual(-1e-12);
      }
    }
  });

  it('shows from above what the plane x-y shows', () => {
    const above = basisOf('space', { azimuth: -90, height: 90 });
    const plane = basisOf('xy', usualTurn);
    above.right.forEach((value, axis) => expect(value).toBeCloseTo(plane.right[axis]!, 12));
    above.up.forEach((value, axis) => expect(value).toBeCloseTo(plane.up[axis]!, 12));
  });

  it('draws each plane with its two axes to the right and upwards, to scale', () => {
    for (const [sight, across, up] of [['xy', 0, 1], ['xz', 0, 2], ['yz', 1, 2]] as const) {
      const p = new Projection(basisOf(sight, usualTurn), box, 400, 300, none, false);
      const from: Point = [1, 2, 3];
      const to = [...from] as [number, number, number];
      to[across] += 2;
      to[up] += 1;
      expect(p.x(...to) - p.x(...from)).toBeCloseTo(2 * p.scale);
      expect(p.y(...to) - p.y(...from)).toBeCloseTo(-p.scale);
      expect(p.right(p.x(...to))).toBeCloseTo(to[across]);
      expect(p.up(p.y(...to))).toBeCloseTo(to[up]);
      expect(p.atRight(to[across])).toBeCloseTo(p.x(...to));
      expect(p.atUp(to[up])).toBeCloseTo(p.y(...to));
    }
  });

  it('holds the whole box at every turn, in one scale however it is turned about', () => {
    const margins = { left: 20, right: 10, top: 5, bottom: 15 };
    for (const height of [4, 34, 90]) {
      const scales = [-120, -60, 0, 45].map((azimuth) => {
        const p = new Projection(basisOf('space', { azimuth, height }), box, 420, 310, margins, true);
        for (const x of [-10, 10]) {
          for (const y of [-10, 10]) {
            for (const z of [0, 8]) {
              expect(p.x(x, y, z)).toBeGreaterThanOrEqual(20 - 1e-9);
              expect(p.x(x, y, z)).toBeLessThanOrEqual(410 + 1e-9);
              expect(p.y(x, y, z)).toBeGreaterThanOrEqual(5 - 1e-9);
              expect(p.y(x, y, z)).toBeLessThanOrEqual(295 + 1e-9);
            }
          }
        }
        return p.scale;
      });
      for (const scale of scales) expect(scale).toBeCloseTo(scales[0]!, 9);
    }
  });

  it('does not divide by a box without extent', () => {
    const p = new Projection(basisOf('xy', usualTurn), { min: [1, 1, 1], max: [1, 1, 1] }, 100, 100, none, false);
    expect(p.x(1, 1, 1)).toBeCloseTo(50);
  });
});

describe('a turn', () => {
  it('follows the hand, stays above the ground and comes round', () => {
    expect(dragged({ azimuth: 0, height: 30 }, 20, 10)).toEqual({ azimuth: -10, height: 35 });
    expect(turned({ azimuth: 175, height: 30 }, 10, 0).azimuth).toBe(-175);
    expect(turned({ azimuth: 0, height: 85 }, 0, 20).height).toBe(90);
    expect(turned({ azimuth: 0, height: 10 }, 0, -20).height).toBe(4);
  });

  it('is kept in the address, unless it is the usual one', () => {
    expect(turnText(usualTurn)).toBeNull();
    expect(parseTurn(turnText({ azimuth: -123.44, height: 7.5 }))).toEqual({ azimuth: -123.4, height: 7.5 });
    for (const text of [null, '', '5', 'a,b', '1,2,3', '9999,10']) expect(parseTurn(text)).toBeNull();
  });
});

describe('the box', () => {
  const truth = track([[10, 10, 8], [0, 0, 0]]);
  const places: (Point | null)[] = [[-10, 0, 0], [6, -8, 0], null];

  it('holds stations and truth, ends on round numbers, and stands on the ground', () => {
    const found = spaceBox(places, truth, [], null)!;
    expect(found).toEqual({ min: [-10, -8, 0], max: [10, 10, 8] });
    expect(groundOf(found)).toBe(0);
  });

  it('takes estimates in, but never lets one that ran away make the rest invisible', () => {
    const near = spaceBox(places, truth, [track([[14, 0, -1]])], null)!;
    expect(near.max[0]).toBeGreaterThanOrEqual(14);
    expect(near.min[2]).toBeLessThanOrEqual(-1);
    expect(groundOf(near)).toBe(0);
    const far = spaceBox(places, truth, [track([[1e6, NaN, 0]])], null)!;
    expect(far.max[0]).toBeLessThan(30);
    expect(far.max[1]).toBe(10);
  });

  it('stays as it is while it fits, and shrinks when far too large', () => {
    const first = spaceBox(places, truth, [], null)!;
    expect(spaceBox(places, track([[9, 9, 7], [0, 0, 0]]), [], first)).toBe(first);
    const after = spaceBox([], track([[0, 0, 0], [1, 1, 1]]), [], first)!;
    expect(after.max[0]).toBeLessThan(3);
    expect(spaceBox([], track([]), [], first)).toBe(first);
  });
});

describe('ways', () => {
  const values: Record<string, Series> = { x: series([0, 1, 2, 3], [0, 1, 2, 3]), y: series([0, 1, 2, 3], [0, 0, NaN, 1]), z: series([0, 1, 2], [5, 6, 7]) };
  const read = (name: string): Series => values[name]!;

  it('are the ticks that all three components have', () => {
    const found = readTrack(read, ['x', 'y', 'z'], 1, 9);
    expect([found.length, [...found.k], [...found.z]]).toEqual([2, [1, 2], [6, 7]]);
    expect(reaches(found, 1, 2)).toBe(true);
    expect(reaches(found, 0, 2)).toBe(false);
    expect(reaches(found, 1, 3)).toBe(false);
  });

  it('end where they stand now; nowhere where the value is missing or long past', () => {
    expect(endOf(readTrack(read, ['x', 'x', 'z'], 0, 2), 2)).toEqual([2, 2, 7]);
    expect(endOf(readTrack(read, ['x', 'y', 'z'], 0, 2), 2)).toBeNull();
    expect(endOf(readTrack(read, ['x', 'x', 'z'], 0, 2), 20)).toBeNull();
  });

  it('know no attack where nothing is known', () => {
    expect(stateAt(read, null, 1)).toBe(0);
    expect(stateAt(read, 'y', 2)).toBe(0);
    expect(stateAt(read, 'x', 3)).toBe(3);
  });
});

describe('a run in space', () => {
  const names = ['truth.px', 'truth.py', 'truth.pz', 'sensor.1.state', ...['1', '2'].flatMap((node) => ['px', 'py', 'pz'].map((c) => `lane.a.${node}.estimate.${c}`)), 'lane.a.fused.estimate.px'];
  const signals = names.map((name, id): Signal => {
    const [, lane, node] = name.startsWith('lane.') ? name.split('.') : [];
    return { id, name, unit: 'm', kind: 'scalar', lane: lane ?? null, node: node ?? null };
  });
  const run = {
    family: 'sparse',
    view: { space: { components: ['px', 'py', 'pz'], unit: 'm' } },
    document: { nodes: { 1: { sensor: { params: { position: [-6, 8, 0] } } }, 2: { sensor: {} } } },
    world: { nodes: [{ id: '1', position: null }, { id: '2', position: null }], links: [{ id: '1-2', from: '1', to: '2' }, { id: '2-1', from: '2', to: '1' }], lanes: [{ id: 'a', method: 'm', adversary: true }], state: [] },
  } as unknown as RunDetail;

  it('has its stations where the document puts them, and each pair of links once', () => {
    const space = spaceModel(run, makeModel(run, signals))!;
    expect(space.stations).toEqual([
      { id: '1', state: 'sensor.1.state', place: [-6, 8, 0] },
      { id: '2', state: null, place: null },
    ]);
    expect(space.links).toHaveLength(1);
    expect(space.truth).toEqual(['truth.px', 'truth.py', 'truth.pz']);
  });

  it('has none without three components that are there', () => {
    const other = { ...run, view: { space: { components: ['px', 'py', 'pw'] } } } as unknown as RunDetail;
    expect(spaceModel(other, makeModel(other, signals))).toBeNull();
    expect(spaceModel({ ...run, view: {} }, makeModel(run, signals))).toBeNull();
  });

  it('draws the nodes that estimate all three, each with a look of its own', () => {
    const model = makeModel(run, signals);
    const ways = waysOf(model.lanes[0]!, model, ['px', 'py', 'pz']);
    expect(ways.map((way) => way.id)).toEqual(['1', '2']);
    expect(lookOf(model, '2')).toEqual(ways[1]!.look);
    const looks = Array.from({ length: 64 }, (_, i) => nodeLook(i));
    expect(new Set(looks.map((look) => `${look.token} ${look.shape}`)).size).toBe(64);
    expect(new Set(looks.map((look) => `${look.token} ${look.dash.join()}`)).size).toBe(64);
  });
});
