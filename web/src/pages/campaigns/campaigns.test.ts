import { describe, expect, it } from 'vitest';
import type { CellSummary, PairedDifference, Statistics } from '../../api/campaigns';
import { noted } from './feed';
import { againstBase } from './paired';
import { parallelScene, parallelTable, pathAxis } from './parallel';
import { svgText } from './scene';
import { bodyOf, leafPaths, pointsOf, readValues, sweepFaults, type Wish } from './start';
import { cellAt, firstMetric, fixedText, metricId, resultsOf, shortPath, sweptAxis } from './stats';
import { dotAt, stripOf } from './strip';
import { surfaceCellAt, surfaceCells, type SurfaceQuestion } from './surface';

const statistics = (lane: string, name: string, cell: number, mean: number, node: string | null = null): Statistics & { cell: number } => ({ lane, node, name, variant: null, mean, se: 0.1, median: mean, min: mean, max: mean, quantiles: {}, n: 4, cell });
const cells: CellSummary[] = [0, 1].flatMap((a) => [10, 20].map((b, j) => ({ cell: 2 * a + j, sweep: { 'x.a': a, 'y.a': b }, done: 4 })));
const results = resultsOf([statistics('one', 'faults', 0, 0), ...cells.map(({ cell }) => statistics('one', 'rmse', cell, cell)), statistics('two', 'rmse', 0, 9, '3')]);

describe('results', () => {
  it('names metrics, the network first, and begins with an error', () => {
    expect(results.metrics.map((one) => one.id)).toEqual(['faults', 'rmse', '3.rmse']);
    expect(firstMetric(results)).toBe('rmse');
    expect(metricId({ node: '2', name: 'nees', variant: 'all' })).toBe('2.nees:all');
    expect(results.of('rmse', 'one', 2)?.mean).toBe(2);
    expect(results.of('rmse', 'two', 0)).toBeUndefined();
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
    expect(surfaceCellAt(question, 400, 300, 100, 250)).toBe(0);
    expect(surfaceCellAt(question, 400, 300, 300, 20)).toBe(3);
    expect(surfaceCellAt(question, 400, 300, 5, 20)).toBeNull();
  });

  it('stacks dots and finds the nearest', () => {
    const { dots } = stripOf([{ index: 7, value: 1 }, { index: 8, value: 1 }, { index: 9, value: 2 }], 1, new Set([9]), 'm', 'lane-0', 400, 150);
    expect(dots[1]!.y).toBeLessThan(dots[0]!.y);
    expect(dotAt(dots, dots[2]!.x + 2, dots[2]!.y)).toBe(9);
    expect(dotAt(dots, 200, 10)).toBeNull();
  });

  it('draws a line a trial and writes what is missing as empty', () => {
    const table = { axes: [pathAxis('p', ['on', 'off']).axis, { name: 'm', words: null }], values: new Float64Array([0, 1.5, 1, NaN]), cells: new Int32Array([0, 1]), rows: 2 };
    expect(parallelTable(table).rows).toEqual([[0, 'on', 1.5], [1, 'off', '']]);
    const svg = svgText(parallelScene(table, 0, false, 400, 300), 'a < b', '#fff', '#000');
    expect(svg).toContain('a &lt; b');
    expect(svg.match(/<path d="M/g)!.length).toBeGreaterThanOrEqual(3);
    expect(svg).not.toContain('NaN');
  });
});

describe('a new campaign', () => {
  const wish: Wish = { scenario: 'consensus', patch: {}, runs: '5', firstSeed: '2', sweep: [{ path: 'a.b', values: '0, 0.5, [1,2], "x,y", word' }, { path: '', values: '' }], samples: false, note: '', trace: '' };

  it('reads values as JSON, or as words', () => {
    expect(readValues(wish.sweep[0]!.values)).toEqual([0, 0.5, [1, 2], 'x,y', 'word']);
    expect(pointsOf(wish.sweep)).toBe(5);
    expect(bodyOf(wish)).toEqual({ scenario: 'consensus', runs: 5, first_seed: 2, sweep: { 'a.b': [0, 0.5, [1, 2], 'x,y', 'word'] } });
    expect(bodyOf({ ...wish, runs: '0' })).toBeUndefined();
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
