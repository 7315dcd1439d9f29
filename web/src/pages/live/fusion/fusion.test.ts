import { describe, expect, it } from 'vitest';
import type { RunDetail, Signal } from '../../../api/types';
import type { Series } from '../../../data/series';
import { makeModel } from '../model';
import { attackedChoices, columnSeries, countChoices, decode, encode, fusionSeries } from './fusion_cells';
import { choiceCell, fusionRows, ownCell } from './fusion_draw';
import { gameOf, type Chooser } from './game';
import { strategyAt } from './strategy';

function series(k: number[], lo: number[], hi?: number[]): Series {
  const low = Float64Array.from(lo);
  return { k: Float64Array.from(k), lo: low, hi: hi ? Float64Array.from(hi) : low, joined: Uint8Array.from(k.map((_, i) => (i && k[i]! - k[i - 1]! === 1 ? 1 : 0))) };
}
const cells = (codes: Series) => [...codes.lo].map((code) => (Number.isNaN(code) ? null : decode(code)));

describe('cells of the fusion raster', () => {
  it('carry choice, own state and the chosen node’s state in one number', () => {
    for (const choice of [{ node: 0, own: 0, chosen: 0 }, { node: 11, own: 6, chosen: 4 }, { node: -1, own: 5, chosen: 0 }, { node: -1, own: 0, chosen: 7 }]) expect(decode(encode(choice))).toEqual(choice);
    expect(decode(Math.fround(encode({ node: 4095, own: 5, chosen: 3 })))).toEqual({ node: 4095, own: 5, chosen: 3 });
  });

  it('look up the state of the node that was chosen at the same tick', () => {
    const sensors = [series([6, 7, 8], [0, 0, 0]), series([6, 7, 8], [0, 4, 4]), series([6, 7, 8], [5, 5, 0])];
    expect(cells(fusionSeries(series([6, 7, 8], [1, 1, 2]), 0, sensors))).toEqual([
      { node: 1, own: 0, chosen: 0 },
      { node: 1, own: 0, chosen: 4 },
      { node: 2, own: 0, chosen: 0 },
    ]);
  });

  it('say nothing of a tick whose states have not come, or without a choice', () => {
    expect(cells(fusionSeries(series([5, 6, 7], [NaN, 1, 1]), 0, [series([5, 6], [0, 0]), series([5, 6, 7], [0, 0, 0])]))).toEqual([null, { node: 1, own: 0, chosen: 0 }, null]);
  });

  it('need no states where the run tells none', () => {
    expect(cells(fusionSeries(series([6], [1]), 0, [null, null]))).toEqual([{ node: 1, own: 0, chosen: 0 }]);
  });

  it('tell of reduced points only what is certain', () => {
    const sensors = [series([0, 10, 20], [0, 0, 0], [0, 0, 4]), series([0, 10, 20], [4, 0, 0], [4, 4, 0])];
    expect(cells(fusionSeries(series([0, 10, 20], [1, 1, 0], [1, 1, 1]), 0, sensors))).toEqual([
      { node: 1, own: 0, chosen: 4 },
      { node: 1, own: 0, chosen: 0 },
      { node: -1, own: 4, chosen: 0 },
    ]);
  });

  it('of several ticks: an attacked choice shows, a shared one stays, else it is several', () => {
    const code = (node: number, own = 0, chosen = 0): number => encode({ node, own, chosen });
    const codes = series([0, 1, 2, 3, 4, 5, 6, 7], [code(1), code(2, 0, 5), code(3), code(3, 4), code(1), code(2), NaN, NaN]);
    const columns = columnSeries(codes, 0, 2, 4);
    expect([...columns.k]).toEqual([0, 2, 4]);
    expect(cells(columns)).toEqual([
      { node: 2, own: 0, chosen: 5 },
      { node: 3, own: 4, chosen: 0 },
      { node: -1, own: 0, chosen: 0 },
    ]);
    expect(columnSeries(codes, 0, 1, 8)).toBe(codes);
  });

  it('join neighbouring attacked choices, not across others', () => {
    const code = (chosen: number): number => encode({ node: 1, own: 0, chosen });
    expect(attackedChoices(series([1, 2, 3, 4, 9], [code(4), code(5), code(0), code(4), code(4)]), 1)).toEqual([
      { from: 1, to: 2 },
      { from: 4, to: 4 },
      { from: 9, to: 9 },
    ]);
  });

  it('are counted inside the window', () => {
    const codes = series([1, 2, 3, 4], [encode({ node: 1, own: 0, chosen: 4 }), encode({ node: 0, own: 4, chosen: 0 }), NaN, encode({ node: 1, own: 0, chosen: 4 })]);
    expect(countChoices([codes, codes], 1, 3)).toEqual({ known: 4, attacked: 2 });
  });
});

describe('how a cell looks', () => {
  const nodes = ['1', '2', '12'];
  const tokens = ['lane-0', 'lane-1', 'lane-2'];
  const all = (text: string): string => text;

  it('its own choice is plain, another node has a colour, an attacked one is ink, whoever it is', () => {
    const look = (choice: Parameters<typeof encode>[0]) => choiceCell(encode(choice), 0, nodes, tokens, all);
    expect(look({ node: 0, own: 0, chosen: 0 })).toEqual({ token: 'surface', letter: '1', letterToken: 'muted' });
    expect(look({ node: 2, own: 4, chosen: 0 })).toEqual({ token: 'lane-2', letter: '12' });
    expect(look({ node: 1, own: 0, chosen: 5 })).toEqual({ token: 'ink', letter: '2' });
    expect(look({ node: 0, own: 4, chosen: 4 })).toEqual({ token: 'ink', letter: '1' });
    expect(look({ node: -1, own: 0, chosen: 0 })).toEqual({ token: 'control' });
  });

  it('the stripe below has the letter of the attack on the node itself', () => {
    expect(ownCell(encode({ node: 1, own: 4, chosen: 0 }), all)?.letter).toBe('I');
    expect(ownCell(encode({ node: 1, own: 5, chosen: 4 }), all)?.letter).toBe('II');
    expect(ownCell(encode({ node: 1, own: 0, chosen: 4 }), all)).toBeNull();
  });

  it('letters appear only where they fit', () => {
    const g = { width: 252, height: 100, left: 44, right: 8, top: 4, bottom: 18, from: 0, to: 20 };
    const row = { id: '1', index: 0, codes: series([3], [encode({ node: 2, own: 0, chosen: 0 })]) };
    const letter = (to: number) => {
      const [choice] = fusionRows({ ...g, to }, [row], nodes, tokens);
      return choice!.cell(choice!.series.lo[0]!, false)?.letter;
    };
    expect(letter(10)).toBe('12');
    expect(letter(16)).toBeUndefined();
  });
});

describe('a game', () => {
  const names = ['lane.dkf.1.estimate.px', 'lane.omp_game.a.choice', 'lane.omp_game.a.utility.a', 'lane.omp_game.a.probability.a', 'lane.omp_game.a.utility.b', 'lane.omp_game.a.probability.b', 'lane.omp_game.b.choice'];
  const signals = names.map((name, id): Signal => {
    const [, lane, node] = name.split('.');
    return { id, name, unit: '', kind: name.endsWith('choice') ? 'category' : 'scalar', lane: lane!, node: node!, labels: name.endsWith('choice') ? { 0: 'a', 1: 'b', 2: 'c' } : undefined };
  });
  const run = { view: {}, world: { nodes: [{ id: 'a', position: null }, { id: 'b', position: null }, { id: 'c', position: null }], links: [], lanes: [{ id: 'dkf', method: '', adversary: true }, { id: 'omp_game', method: '', adversary: true }], state: [] } } as unknown as RunDetail;

  it('is that of the chosen lane, or of the first that has one', () => {
    const model = makeModel(run, signals);
    for (const lane of ['omp_game', 'dkf', null]) expect(gameOf(model, lane)?.lane.id).toBe('omp_game');
    const game = gameOf(model, 'dkf')!;
    expect(game.nodes).toEqual(['a', 'b', 'c']);
    expect(game.choosers.map((one) => [one.id, one.candidates.map((candidate) => candidate.id)])).toEqual([
      ['a', ['a', 'b']],
      ['b', []],
    ]);
    expect(gameOf(makeModel(run, signals.slice(0, 1)), null)).toBeNull();
  });

  const chooser: Chooser = { id: 'a', choice: 'c', candidates: ['a', 'b', 'd'].map((id) => ({ id, utility: `u${id}`, probability: `p${id}` })) };
  const at = (values: Record<string, number>, choice?: string) => strategyAt(chooser, (signal) => values[signal] ?? NaN, choice, (id) => (id === 'b' ? 4 : 0));

  it('at the cursor: candidates there are, who was taken, who is attacked, bars between least and greatest utility', () => {
    const strategy = at({ ua: -3, ub: -11, pa: 0.9, pb: 0.1 }, 'a');
    expect(strategy.rows).toEqual([
      { id: 'a', probability: 0.9, utility: -3, utilityShare: 1, taken: true, state: 0 },
      { id: 'b', probability: 0.1, utility: -11, utilityShare: 0, taken: false, state: 4 },
    ]);
    expect([strategy.idle, strategy.uniform]).toEqual([false, false]);
    expect(at({ ua: 0, ub: -4, ud: -1, pa: 0.5, pb: 0.2, pd: 0.3 }).rows.map((row) => row.utilityShare)).toEqual([1, 0, 0.75]);
  });

  it('that has not begun is idle; one without a preference says so', () => {
    expect(at({})).toMatchObject({ rows: [], idle: true, uniform: false });
    expect(at({ ua: 9.2, ub: 9.2, pa: 0.5, pb: 0.5 })).toMatchObject({ idle: false, uniform: true });
    expect(at({ ua: 9.2, pa: 1 }).uniform).toBe(false);
  });
});
