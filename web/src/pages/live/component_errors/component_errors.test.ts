import { describe, expect, it } from 'vitest';
import type { RunDetail, Signal } from '../../../api/types';
import type { Series } from '../../../data/series';
import { readLine } from '../lines';
import { laneOf, makeModel } from '../model';
import { errorLines, referenceLane } from './error_lines';

const names = ['truth.px', 'truth.vx', ...['a', 'pred'].flatMap((lane) => ['1', '2'].flatMap((node) => ['px', 'vx'].map((c) => `lane.${lane}.${node}.estimate.${c}`)))];
const signals = names.map((name, id): Signal => {
  const [, lane, node] = name.startsWith('lane.') ? name.split('.') : [];
  return { id, name, unit: name.endsWith('vx') ? 'm/s' : 'm', kind: 'scalar', lane: lane ?? null, node: node ?? null };
});
const run = {
  view: {},
  world: { nodes: [{ id: '1', position: null }, { id: '2', position: null }], links: [], lanes: [{ id: 'a', method: 'omp_game', adversary: true }, { id: 'pred', method: 'dead_reckoning', adversary: false }], state: [] },
} as unknown as RunDetail;
const model = makeModel(run, signals);

function series(values: number[]): Series {
  const v = Float64Array.from(values);
  return { k: Float64Array.from(values.keys()), lo: v, hi: v, joined: Uint8Array.from(values, (_, i) => (i ? 1 : 0)) };
}

describe('errors per node', () => {
  it('are one line a node for each component, with the reference once and thin under them', () => {
    const found = errorLines(model, laneOf(model, 'a')!, ['px', 'vx'], '2');
    expect(found.map(({ component, unit }) => [component, unit])).toEqual([['px', 'm'], ['vx', 'm/s']]);
    expect(found[0]!.lines.map((line) => [line.name, line.signal, line.minus])).toEqual([
      ['pred', 'lane.pred.1.estimate.px', 'truth.px'],
      ['1', 'lane.a.1.estimate.px', 'truth.px'],
      ['2', 'lane.a.2.estimate.px', 'truth.px'],
    ]);
    const [under, one, two] = found[0]!.lines;
    expect(under!.width).toBeLessThan(one!.width);
    expect(two!.strong).toBe(true);
    expect(`${one!.token} ${one!.dash.join()}`).not.toBe(`${two!.token} ${two!.dash.join()}`);
  });

  it('need no reference beside the reference itself, and none where there is none', () => {
    expect(errorLines(model, laneOf(model, 'pred')!, ['px'], null)[0]!.lines.map((line) => line.name)).toEqual(['1', '2']);
    const alone = makeModel({ ...run, world: { ...run.world, lanes: run.world.lanes.slice(0, 1) } }, signals.filter((signal) => signal.lane !== 'pred'));
    expect(referenceLane(alone)).toBeNull();
    expect(errorLines(alone, laneOf(alone, 'a')!, ['px'], null)[0]!.reference).toBe(false);
  });

  it('leave out what nobody estimates or the truth does not have', () => {
    expect(errorLines(model, laneOf(model, 'a')!, ['pz', 'vx'], null).map(({ component }) => component)).toEqual(['vx']);
  });

  it('keep their sign', () => {
    const [, line] = errorLines(model, laneOf(model, 'a')!, ['px'], null)[0]!.lines;
    const values: Record<string, Series> = { 'truth.px': series([10, 9, 8]), 'lane.a.1.estimate.px': series([10, 8.5, 9]) };
    expect([...readLine(line!, (name) => values[name]!).lo]).toEqual([0, -0.5, 1]);
  });
});
