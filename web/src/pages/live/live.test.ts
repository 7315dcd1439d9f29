import { describe, expect, it } from 'vitest';
import type { Mark, RunDetail, Signal } from '../../api/types';
import { csvText } from './export';
import { squared } from './lines';
import { activeAttacks, groupMarks, isMark, mergeMarks, neighbour } from './mark_order';
import { runMetric } from './metrics';
import { laneOf, makeModel } from './model';
import { panelsOf, wideTemplate } from './panels';
import { planeBox } from './plane_draw';
import { searchSignals } from './signal_search';
import { seriesTable } from './table';
import { defaultWidth, parseView, viewQuery, type ViewState } from './view_url';

const read = (query: string) => (key: string) => new URLSearchParams(query).get(key);

describe('the view in the address', () => {
  it('comes back as it went', () => {
    const view: ViewState = { range: { from: 12, to: 480 }, width: 300, cursor: 77, lane: 'naive_hold', node: '5', hidden: ['drop', 'clean'], signals: ['truth.x'], errors: 'nodes', curves: ['local', 'other.zero'] };
    const query = new URLSearchParams();
    for (const [key, value] of Object.entries(viewQuery(view))) if (value !== null) query.set(key, String(value));
    expect(parseView((key) => query.get(key))).toEqual(view);
  });

  it('of a plain address is the live one, and stays plain', () => {
    const view = parseView(read(''));
    expect(view).toMatchObject({ range: null, width: defaultWidth, cursor: null, hidden: [] });
    expect(Object.values(viewQuery(view)).every((value) => value === null)).toBe(true);
  });

  it.each(['range=9-3', 'range=a-b', 'range=5', 'range=-1-5', 'width=2', 'k=1.5', 'k=-4', 'range=1-2-3'])('ignores what is malformed: %s', (query) => {
    expect(parseView(read(query))).toEqual(parseView(read('')));
  });
});

describe('marks', () => {
  const mark = (k: number, more: Partial<Mark> = {}): Mark => ({ k, type: 'attack', edge: null, ...more });

  it('are checked before they are drawn', () => {
    expect(isMark({ k: 3, type: 'alarm', edge: 'begin' })).toBe(true);
    expect(isMark({ k: 3, type: 'state' })).toBe(true);
    for (const wrong of [null, 3, {}, { k: '3', type: 'alarm' }, { k: 3, type: 'party' }, { k: 3, type: 'fault', edge: 'middle' }]) expect(isMark(wrong)).toBe(false);
  });

  it('merge by tick, none twice', () => {
    const merged = mergeMarks([mark(1, { id: 'a' }), mark(5)], [mark(3), mark(1, { id: 'a' })]);
    expect(merged.map((one) => one.k)).toEqual([1, 3, 5]);
  });

  it('of a restless detector are cut, and the attack among them is kept', () => {
    const alarms = Array.from({ length: 6000 }, (_, k) => mark(k + 1, { type: 'alarm', edge: k % 2 ? 'end' : 'begin', lane: 'a' }));
    const merged = mergeMarks([mark(1, { id: 'a1', edge: 'begin' }), ...alarms], [mark(2, { type: 'command' })]);
    expect(merged).toHaveLength(5000);
    expect(merged.slice(0, 3).map((one) => [one.k, one.type])).toEqual([[1, 'attack'], [2, 'command'], [1003, 'alarm']]);
    expect(activeAttacks(merged).map((one) => one.id)).toEqual(['a1']);
  });

  it('say which attacks go on', () => {
    const marks = [mark(1, { id: 'links', edge: 'begin' }), mark(4, { id: 'a1', edge: 'begin' }), mark(9, { id: 'a1', edge: 'end' }), mark(9, { id: 'a2', edge: 'begin' })];
    expect(activeAttacks(marks).map((one) => one.id)).toEqual(['links', 'a2']);
  });

  it('that say the same of several nodes are one line, newest first', () => {
    const fault = (node: string, k = 2): Mark => mark(k, { type: 'fault', edge: 'begin', lane: 'a', code: 'infeasible_28', node, detail: node });
    const groups = groupMarks([mark(1, { id: 'links' }), fault('1'), fault('2'), fault('3'), fault('1', 4)], 10);
    expect(groups.map((group) => [group.mark.k, group.nodes, group.count])).toEqual([
      [4, ['1'], 1],
      [2, ['1', '2', '3'], 3],
      [1, [], 1],
    ]);
    expect(groupMarks([mark(1), mark(2), mark(3)], 2).map((group) => group.mark.k)).toEqual([3, 2]);
  });

  it('are stepped through', () => {
    const marks = [mark(1), mark(5), mark(9)];
    expect(neighbour(marks, 5, 1)?.k).toBe(9);
    expect(neighbour(marks, 5, -1)?.k).toBe(1);
    expect(neighbour(marks, 9, 1)).toBeNull();
  });
});

describe('what a run offers', () => {
  const names = ['truth.x', 'truth.y', 'link.1-2.state', 'lane.a.1.estimate.x', 'lane.a.1.estimate.y', 'lane.a.1.error', 'lane.a.1.feasible28', 'lane.a.rmse', 'lane.mine.1.error'];
  const signals = names.map((name, id): Signal => {
    const [, lane, node] = name.startsWith('lane.') ? name.split('.') : [];
    return { id, name, unit: 'cm', kind: 'scalar', lane: lane ?? null, node: name === 'lane.a.rmse' ? null : (node ?? null) };
  });
  const run = {
    view: { plane: { components: ['x', 'y'], unit: 'cm' } },
    world: { nodes: [{ id: '1', position: [1, 2] }, { id: '2', position: null }], links: [{ id: '1-2', from: '1', to: '2' }, { id: '2-1', from: '2', to: '1' }], lanes: [{ id: 'a', method: 'm', adversary: true }], state: [] },
  } as unknown as RunDetail;

  it('is read from its catalogue', () => {
    const model = makeModel(run, signals);
    expect(model.plane).toEqual({ x: 'truth.x', y: 'truth.y', unit: 'cm' });
    expect(model.links.map((link) => link.state)).toEqual(['link.1-2.state', null]);
    expect(model.nodes).toEqual([{ id: '1', position: [1, 2], state: null }, { id: '2', position: null, state: null }]);
    const lane = laneOf(model, 'a')!;
    expect(lane.rmse).toBe('lane.a.rmse');
    expect([...lane.estimate]).toEqual([['1', ['lane.a.1.estimate.x', 'lane.a.1.estimate.y']]]);
    expect(lane.feasible28.get('1')).toBe('lane.a.1.feasible28');
    expect(lane.bound.size).toBe(0);
  });

  it('has lanes computed elsewhere after its own, and takes the first for an unknown one', () => {
    const model = makeModel(run, signals);
    expect(model.lanes.map((lane) => lane.id)).toEqual(['a', 'mine']);
    expect(laneOf(model, 'nobody')?.id).toBe('a');
    expect(laneOf(makeModel({ ...run, view: { lane: 'mine' } }, signals), null)?.id).toBe('mine');
  });

  it('decides the panels: a family has its own, another run those it has the data for', () => {
    const shown = (change: Partial<RunDetail>, known = signals): string[] => panelsOf({ ...run, ...change }, makeModel({ ...run, ...change }, known)).map((panel) => panel.name);
    expect(shown({ family: 'consensus' })).toEqual(['plane', 'errors', 'raster', 'feasible', 'bound', 'events', 'attacks']);
    expect(shown({ family: 'consensus' }, [])).toEqual(['plane', 'errors', 'raster', 'feasible', 'bound', 'events', 'attacks']);
    expect(shown({ family: 'observer', view: {} }, [])).toEqual(['events', 'network', 'attacks']);
    expect(shown({ family: 'observer', view: {} }, signals.slice(5, 6))).toEqual(['errors', 'events', 'network', 'attacks']);
  });

  it('gives the rows of the first screen their shares', () => {
    expect(wideTemplate({ wide: [1, 3], middle: [] })).toBe('calc((max(100cqh, 560px) - 1 * var(--gap)) * 0.25) calc((max(100cqh, 560px) - 1 * var(--gap)) * 0.75)');
  });

  it('can be nothing at all', () => {
    const model = makeModel({ ...run, view: {}, world: { nodes: [], links: [], lanes: [], state: [] } } as unknown as RunDetail, []);
    expect(model).toMatchObject({ plane: null, lanes: [], links: [] });
  });

  it('is searched by words', () => {
    expect(searchSignals(signals, 'error lane', 10).map((signal) => signal.name)).toEqual(['lane.a.1.error', 'lane.mine.1.error']);
    expect(searchSignals(signals, ' ', 10)).toEqual([]);
    expect(searchSignals(signals, 'truth', 1)).toHaveLength(1);
  });
});

describe('panels', () => {
  it('read a lane’s figure over the whole network', () => {
    const metrics = [
      { lane: 'a', node: '1', name: 'rmse_position', variant: null, value: 9 },
      { lane: 'a', node: null, name: 'rmse_position', variant: null, value: 2.6 },
      { lane: 'a', node: null, name: 'bound_guaranteed', variant: null, value: false },
    ];
    expect(runMetric(metrics, 'a', 'rmse_position')).toBe(2.6);
    expect(runMetric(metrics, 'a', 'bound_guaranteed')).toBe(false);
    expect(runMetric(metrics, 'b', 'rmse_position')).toBeNull();
  });

  it('square an error to compare it with a trace', () => {
    const v = Float64Array.of(2, -3, NaN);
    const out = squared({ k: Float64Array.of(0, 1, 2), lo: v, hi: v, joined: Uint8Array.of(0, 1, 1) });
    expect([...out.lo]).toEqual([4, 9, NaN]);
    expect(out.hi).toBe(out.lo);
  });

  it('give their data as rows, newest first, with both extremes', () => {
    const lo = Float64Array.of(1, 2);
    const table = seriesTable([{ name: 'e', series: { k: Float64Array.of(0, 10), lo, hi: Float64Array.of(3, 2), joined: Uint8Array.of(0, 1) } }], 0, 10);
    expect(table.columns).toEqual(['k', 'e']);
    expect(table.rows).toEqual([
      ['10', '2.000'],
      ['0', '1.000 … 3.000'],
    ]);
  });

  it('write CSV that survives commas and quotes', () => {
    expect(csvText(['k', 'detail'], [[1, 'a, "b"']])).toBe('k,detail\n1,"a, ""b"""\n');
  });

  it('keep the plane’s box while everything is inside', () => {
    const track = (x: number[], y: number[]) => {
      const make = (v: number[]) => ({ k: Float64Array.from(v.keys()), lo: Float64Array.from(v), hi: Float64Array.from(v), joined: new Uint8Array(v.length).fill(1) });
      return { x: make(x), y: make(y) };
    };
    const scene = (x: number[]) => ({ nodes: [{ id: '1', position: [0, 0] as [number, number] }, { id: '2', position: [10, 10] as [number, number] }], links: [], truth: track(x, x), estimates: [], token: '', at: 99, trail: 100 });
    const first = planeBox(scene([1, 5]), null)!;
    expect(planeBox(scene([2, 8]), first)).toBe(first);
    expect(planeBox(scene([2, 80]), first)!.x1).toBeGreaterThan(80);
  });
});
