import { describe, expect, it } from 'vitest';
import type { CampaignResults, CellSummary, MetricName, PairedDifference, Statistics } from '../../api/campaigns';
import { brushed, withBrush } from './brush';
import { LineDensity } from './density';
import { noted } from './feed';
import { pointHits, valueAt, zoomAround, zoomOf } from './hits';
import { againstBase } from './paired';
import { brushOf, frameOf, parallelHits, parallelScene, parallelTable, pathAxis, rowText, type TrialTable } from './parallel';
import { svgText } from './scene_svg';
import { bodyOf, leafPaths, pointsOf, readValues, sweepFaults, type Wish } from './start';
import { cellAt, doneOf, exactText, firstMetric, fixedText, metricId, resultsOf, shortPath, sweptAxis, takeFigures, valueText } from './stats';
import { stripScene } from './strip';
import { surfaceCells, surfaceScene, type SurfaceQuestion } from './surface';

const cells: CellSummary[] = [0, 1].flatMap((a) => [10, 20].map((b, j) => ({ cell: 2 * a + j, sweep: { 'x.a': a, 'y.a': b } })));
const names: MetricName[] = [
  { id: '3.rmse', node: '3', lanes: [1] },
  { id: 'faults', node: null, lanes: [0] },
  { id: 'rmse', node: null, lanes: [0] },
];
const figures = ['mean', 'se', 'median', 'min', 'max', '0.05', '0.25', '0.75', '0.95', 'n'];
const answer = (from: number, rows: (number | null)[][]): CampaignResults => ({ from, done: 16, lanes: ['one'], metrics: ['rmse'], figures, rows });
const row = (cell: number, mean: number): (number | null)[] => [cell, 0, 0, mean, null, mean, mean, mean, 1, 2, 3, 4, 4];
const figureTable = new Map<string, Statistics>();
takeFigures(figureTable, answer(0, cells.map(({ cell }) => row(cell, cell))));
const results = resultsOf({ lanes: ['one', 'two'], metrics: names }, figureTable);

describe('results', () => {
  it('names metrics, the network first, and begins with an error', () => {
    expect(results.metrics.map((one) => one.id)).toEqual(['faults', 'rmse', '3.rmse']);
    expect(firstMetric(results.metrics)).toBe('rmse');
    expect(metricId({ node: '2', name: 'nees', variant: 'all' })).toBe('2.nees:all');
    expect(results.of('rmse', 'one', 2)).toMatchObject({ mean: 2, se: null, quantiles: { '0.05': 1, '0.95': 4 }, n: 4 });
    expect(results.of('rmse', 'two', 0)).toBeUndefined();
    expect([results.has('3.rmse', 1), results.has('rmse', 1)]).toEqual([true, false]);
  });

  it('takes what is told anew in the place of the old', () => {
    const table = new Map(figureTable);
    takeFigures(table, answer(3, [row(3, 7)]));
    const now = resultsOf({ lanes: ['one'], metrics: names }, table);
    expect([now.of('rmse', 'one', 2)?.mean, now.of('rmse', 'one', 3)?.mean]).toEqual([2, 7]);
    const progress = { done: 9, trials: 16, failed: 0, trials_per_second: null, seconds_left: null };
    expect([0, 2, 3].map((cell) => doneOf({ progress, runs: 4 }, cell))).toEqual([4, 1, 0]);
  });

  it('finds cells by their point, in any order of its paths', () => {
    expect(cellAt(cells, { 'y.a': 20, 'x.a': 1 })?.cell).toBe(3);
    expect(cellAt(cells, { 'y.a': 30, 'x.a': 1 })).toBeUndefined();
    expect(fixedText({ 'x.a': 1, 'y.a': 20 }, ['x.a'])).toBe('y.a 20');
    expect(shortPath('x.a', ['x.a', 'y.a'])).toBe('x.a');
    expect(shortPath('x.a', ['x.a', 'y.b'])).toBe('a');
  });

  it('puts numbers in order and leaves words as they come', () => {
    expect(sweptAxis('p', [3, 1, 2]).at).toEqual([1, 2, 3]);
    expect([valueText(0.1 + 0.2), exactText(0.1 + 0.2)]).toEqual(['0.3', '0.30000000000000004']);
    expect(sweptAxis('p', ['b', 'a'])).toMatchObject({ numeric: false, values: ['b', 'a'], at: [0, 1] });
  });
});

describe('figures', () => {
  it('turns pairs so that all are against the base', () => {
    const pair: PairedDifference = { base: 'a', lane: 'b', node: null, name: 'rmse', variant: null, mean: -2, se: 1, lo: -4, hi: -1, p: 0.1, n: 5 };
    expect(againstBase([pair], 'rmse', 'b')).toEqual([{ ...pair, base: 'b', lane: 'a', mean: 2, lo: 1, hi: 4 }]);
    expect(againstBase([pair], 'rmse', 'a')).toEqual([pair]);
    expect(againstBase([pair], 'other', 'a')).toEqual([]);
  });

  it('finds the surface’s cell under the pointer', () => {
    const question: SurfaceQuestion = { results, metric: 'rmse', lane: 0, x: sweptAxis('x.a', [0, 1]), y: sweptAxis('y.a', [10, 20]), cells, point: cells[0]!.sweep };
    expect(surfaceCells(question).map((one) => one.mean)).toEqual([0, 1, 2, 3]);
    const hits = surfaceScene(question, 0, 400, 300).hits!;
    const key = (x: number, y: number): number | undefined => (hits.near(x, y) < 0 ? undefined : hits.at(hits.near(x, y)).key);
    expect([key(100, 250), key(300, 20), key(5, 20)]).toEqual([0, 3, undefined]);
    expect(hits.at(hits.near(300, 20)).text).toBe('1, 20: 3.00');
  });

  it('stacks dots, finds the nearest, and leaves out what a zoom leaves out', () => {
    const question = { values: [{ index: 7, value: 1 }, { index: 8, value: 1 }, { index: 9, value: 2 }], median: 1, outliers: new Set([9]), metric: 'm', token: 'lane-0', say: (index: number) => `trial ${index}` };
    const hits = stripScene(question, 400, 150).hits!;
    const at = [0, 1, 2].map((i) => hits.at(i));
    expect(at.map((one) => one.key)).toEqual([8, 7, 9]);
    expect(at[0]!.y).toBeLessThan(at[1]!.y);
    expect(hits.at(hits.near(at[2]!.x + 2, at[2]!.y)).text).toBe('trial 9');
    expect(hits.near(200, 10)).toBe(-1);
    expect(stripScene(question, 400, 150, { x: { lo: 1.5, hi: 2 } }).hits!.count).toBe(1);
  });

  it('zooms to what a stroke covers and around a place', () => {
    const box = { left: 0, right: 100, top: 0, bottom: 50 };
    const linear = { log: false, lo: 10, hi: 20 };
    expect(zoomOf({ box, x: linear }, 75, 3, 25, 40)).toEqual({ x: { lo: 12.5, hi: 17.5 } });
    expect(zoomOf({ box, x: linear, y: { log: true, lo: 1, hi: 100 } }, 0, 50, 100, 25)).toEqual({ x: { lo: 10, hi: 20 }, y: { lo: 1, hi: 10 } });
    expect(zoomOf({ box, x: linear }, 75, 3, 78, 40)).toBeNull();
    expect(zoomAround({ box, x: linear }, 50, 0, 0.5)).toEqual({ x: { lo: 12.5, hi: 17.5 } });
    expect(valueAt({ log: true, lo: 1, hi: 100 }, 0.5)).toBeCloseTo(10);
    expect(pointHits([{ x: 5, y: 0, text: 'b' }, { x: 1, y: 0, text: 'a' }]).at(0).text).toBe('a');
  });
});

describe('parallel coordinates', () => {
  const table: TrialTable = { axes: [pathAxis('p', ['on', 'off']).axis, { name: 'one.m', words: null }], values: new Float64Array([0, 1.5, 1, NaN, 1, 4.5]), cells: new Int32Array([0, 1, 1]), rows: 3, runs: 2, firstSeed: 10 };
  const all = new Int32Array([0, 1, 2]);

  it('draws a line a trial and writes what is missing as empty', () => {
    expect(parallelTable(table, all).rows).toEqual([[0, 10, 0, 'on', 1.5], [1, 11, 1, 'off', ''], [2, 10, 1, 'off', 4.5]]);
    const svg = svgText(parallelScene(table, all, new Map(), false, 400, 300), 'a < b', '#fff', '#000');
    expect(svg).toContain('a &lt; b');
    expect(svg.match(/<path d="M/g)!.length).toBeGreaterThanOrEqual(3);
    expect(svg).not.toContain('NaN');
  });

  it('chooses the trials within every brush', () => {
    const above = withBrush(new Map(), 'one.m', { lo: 1, hi: 2 });
    expect([...brushed(table, above)]).toEqual([0]);
    expect([...brushed(table, withBrush(above, 'p', { lo: 0.5, hi: 1.5 }))]).toEqual([]);
    expect([...brushed(table, withBrush(above, 'one.m', null))]).toEqual([0, 1, 2]);
  });

  it('brushes the axis under the pointer, and finds the line between two axes', () => {
    const frame = frameOf(table, new Map(), false, 400, 300);
    expect(brushOf(frame, 380, frame.bottom, (frame.top + frame.bottom) / 2)).toEqual({ name: 'one.m', lo: 1.5, hi: 3 });
    expect(brushOf(frame, 200, 50, 60)).toBeNull();
    const hits = parallelHits(table, frame, all, (one) => rowText(table, one));
    const { path } = hits.at(0);
    const middle = (path![1]! + path![3]!) / 2;
    expect(hits.at(hits.near(200, middle + 3)).key).toBe(0);
    expect(hits.at(0).text).toBe('p on · one.m 1.50');
    expect(frameOf(table, new Map([['one.m', { lo: -Infinity, hi: 2 }]]), true, 400, 300).axes[1]!.scale).toEqual({ log: false, lo: 1.5, hi: 2 });
  });

  it('counts every line once a column or row, in slices, and leaves out what has no value', () => {
    const points = new Float32Array([0, 2.5, 8, 2.5, 0, 0, 8, NaN, 0, 0, 2, 6]);
    const job = new LineDensity(8, 8, points, 2, 1);
    expect(job.work(1)).toBe(true);
    const sums = Array.from({ length: 8 }, (_, x) => Array.from({ length: 8 }, (_, y) => job.counts[y * 8 + x]!).reduce((a, b) => a + b));
    expect(sums.slice(3)).toEqual([1, 1, 1, 1, 1]);
    expect([...job.counts].reduce((a, b) => a + b)).toBeCloseTo(8 + 6);
    const pixels = new Uint32Array(64);
    job.paint(pixels, 0xff0000ff, 0.5);
    expect(pixels[2 * 8 + 7]).toBe(((Math.round(255 * (1 - 0.5 ** 0.5)) << 24) | 0xff) >>> 0);
    expect(pixels[63]).toBe(0);
    const many = new LineDensity(8, 8, new Float32Array(4 * 200).fill(1), 2, 1);
    let clock = 0;
    let slices = 1;
    while (!many.work(1, () => clock++)) slices++;
    expect(slices).toBe(4);
  });
});

describe('a new campaign', () => {
  const wish: Wish = { scenario: 'consensus', patch: {}, runs: '5', firstSeed: '2', sweep: [{ path: 'a.b', values: '0, 0.5, [1,2], "x,y", word' }, { path: '', values: '' }], samples: false, note: '', trace: '', workers: false };

  it('reads values as JSON, or as words', () => {
    expect(readValues(wish.sweep[0]!.values)).toEqual([0, 0.5, [1, 2], 'x,y', 'word']);
    expect(pointsOf(wish.sweep)).toBe(5);
    expect(bodyOf(wish)).toEqual({ scenario: 'consensus', runs: 5, first_seed: 2, sweep: { 'a.b': [0, 0.5, [1, 2], 'x,y', 'word'] } });
    expect(bodyOf({ ...wish, runs: '0' })).toBeUndefined();
    expect(bodyOf({ ...wish, workers: true })?.crew).toBe('workers');
    expect(bodyOf({ ...wish, workers: true, samples: true })).toMatchObject({ samples: true });
    expect(bodyOf({ ...wish, workers: true, samples: true })?.crew).toBeUndefined();
  });

  it('says what is wrong with a sweep', () => {
    const document = { a: { b: 1 }, c: 2 };
    expect(sweepFaults(wish.sweep, document)).toEqual(['', '']);
    expect(sweepFaults([{ path: 'a.x', values: '1' }], document)[0]).toContain('a.x');
    expect(sweepFaults([{ path: 'a.b', values: '1' }, { path: 'a.b', values: '1' }], document)[1]).not.toBe('');
    expect(sweepFaults([{ path: '', values: '1' }, { path: 'a.b', values: '' }], document).every((fault) => fault !== '')).toBe(true);
    expect(leafPaths({ a: { b: 1, c: 'word' }, title: { en: 'x' } })).toEqual(['a.b']);
  });
});

it('takes from the feed what it says and keeps the rest', () => {
  const item = { state: 'running' as const, progress: { done: 3, trials: 10, failed: 1, trials_per_second: 2, seconds_left: 4 } };
  expect(noted(item, { id: '1', state: 'paused' })).toEqual({ state: 'paused', progress: { done: 3, trials: 10, failed: 1, trials_per_second: null, seconds_left: null } });
  expect(noted(item, { id: '1', state: 'running', done: 5, trials_per_second: 3, seconds_left: 1.5 }).progress).toEqual({ done: 5, trials: 10, failed: 1, trials_per_second: 3, seconds_left: 1.5 });
});
