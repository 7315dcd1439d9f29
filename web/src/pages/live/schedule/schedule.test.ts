import { describe, expect, it } from 'vitest';
import type { RunDetail } from '../../../api/types';
import type { Series } from '../../../data/series';
import { nodeShown, sensorRasterCell, sensorsAttacked, stationsOf } from './schedule_cells';
import { rowBoxes } from './schedule_draw';
import { stretches } from './stretches';

function series(k: number[], lo: number[], hi?: number[]): Series {
  const low = Float64Array.from(lo);
  return { k: Float64Array.from(k), lo: low, hi: hi ? Float64Array.from(hi) : low, joined: Uint8Array.from(k.map((_, i) => (i ? 1 : 0))) };
}

describe('the schedule of attacks on sensors', () => {
  it('has a letter for every kind; of several ticks only that there was an attack', () => {
    expect([0, 1, 2, 3, 4, 5, 6].map((value) => sensorRasterCell(value, false)?.letter ?? null)).toEqual([null, 'D', 'F', 'R', 'I', 'II', 'R']);
    const tokens = [1, 2, 3, 4, 5, 6].map((value) => sensorRasterCell(value, false)!.token);
    expect(tokens[2]).not.toBe(tokens[5]);
    expect(sensorRasterCell(5, true)).toEqual({ token: 'attacked' });
    expect(sensorRasterCell(NaN, false)).toBeNull();
    expect(sensorRasterCell(9, false)).toEqual({ token: 'attacked' });
  });

  it('is shown where anything acts on a sensor: in the scenario, or begun by hand', () => {
    const run = (adversary: unknown, commands: unknown[] = []) => sensorsAttacked({ document: { adversary }, commands } as unknown as RunDetail);
    expect(run({ links: { type: 'dos', on: ['link:*'] } })).toBe(false);
    expect(run({ node1: { type: 'radar_fdi', on: ['sensor:1'] } })).toBe(true);
    expect(run({}, [{ k: 3, body: { attack: { type: 'bias', on: ['sensor:2.range'] } } }])).toBe(true);
    expect(sensorsAttacked({} as RunDetail)).toBe(false);
  });

  it('knows the nodes whose state the run tells', () => {
    expect(stationsOf({ nodes: [{ id: '1', position: null, state: 'sensor.1.state' }, { id: '2', position: null, state: null }] })).toEqual([{ id: '1', state: 'sensor.1.state' }]);
  });

  it('begins with the node that is attacked first, unless one is chosen', () => {
    const attack = (node: string, from?: number) => ({ on: [`sensor:${node}`], from });
    const run = (adversary: unknown) => ({ document: { adversary } }) as unknown as RunDetail;
    const nodes = ['1', '2', '3', '12'];
    expect(nodeShown('3', nodes, run({ a: attack('1', 5) }))).toBe('3');
    expect(nodeShown('7', nodes, run({ a: attack('1', 180), b: attack('2'), c: attack('3', 120) }))).toBe('2');
    expect(nodeShown(null, nodes, run({ a: attack('12.range', 3), b: { on: 'link:*' }, c: null }))).toBe('12');
    expect([nodeShown(null, nodes, null), nodeShown(null, [], null)]).toEqual(['1', null]);
  });

  it('joins ticks of one look, apart where the kind changes or ticks are missing', () => {
    expect(stretches(series([0, 1, 2, 3, 4], [0, 4, 4, 5, 0]))).toEqual([
      { from: 1, to: 3, token: sensorRasterCell(4, false)!.token, letter: 'I' },
      { from: 3, to: 4, token: sensorRasterCell(5, false)!.token, letter: 'II' },
    ]);
    // The frame of tick 6 stands for the ticks from 2 on.
    expect(stretches(series([0, 1, 6], [0, 0, 4])).map(({ from, to }) => [from, to])).toEqual([[2, 7]]);
    // A piece of a ring begins with a point that goes on from one outside.
    const piece = { ...series([5, 6], [4, 4]), joined: Uint8Array.of(1, 1) };
    expect(stretches(piece).map(({ from, to }) => [from, to])).toEqual([[5, 7]]);
    const gap = { ...series([0, 9], [4, 4]), joined: Uint8Array.of(0, 0) };
    expect(stretches(gap).map(({ from, to }) => [from, to])).toEqual([
      [0, 1],
      [9, 10],
    ]);
    expect(stretches(series([0, 10], [0, 4], [4, 4])).map(({ from, to, token }) => [from, to, token])).toEqual([
      [0, 10, 'attacked'],
      [10, 11, sensorRasterCell(4, false)!.token],
    ]);
  });

  it('has a bar a node, none on another', () => {
    const g = { width: 400, height: 122, left: 44, right: 8, top: 4, bottom: 18, from: 0, to: 10 };
    for (const count of [1, 5, 64]) {
      const boxes = rowBoxes(g, count);
      expect(boxes).toHaveLength(count);
      boxes.slice(1).forEach((box, i) => expect(box.y).toBeGreaterThan(boxes[i]!.y + boxes[i]!.height));
    }
  });
});
