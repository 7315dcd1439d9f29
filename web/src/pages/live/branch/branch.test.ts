import { describe, expect, test } from 'vitest';
import type { Series } from '../../../data/series';
import { after, drawnBy } from './lines';
import { forkTick } from './relation';

const run = (id: string, parent: { run: string; k: number } | null = null): { id: string; parent: typeof parent } => ({ id, parent });

describe('branches', () => {
  test('a fork and its origin are the same up to the fork; two forks of one run up to the earlier', () => {
    expect(forkTick(run('2', { run: '1', k: 12 }), run('1'))).toBe(12);
    expect(forkTick(run('1'), run('2', { run: '1', k: 12 }))).toBe(12);
    expect(forkTick(run('2', { run: '1', k: 12 }), run('3', { run: '1', k: 7 }))).toBe(7);
  });

  test('runs that nothing joins are no branches', () => {
    expect(forkTick(run('1'), run('2'))).toBeNull();
    expect(forkTick(run('1'), run('1'))).toBeNull();
    expect(forkTick(run('2', { run: '1', k: 3 }), run('4', { run: '3', k: 3 }))).toBeNull();
  });
});

describe('the other branch’s curve', () => {
  const values = Float64Array.from([5, 6, 7, 8]);
  const series: Series = { k: Float64Array.from([1, 2, 3, 4]), lo: values, hi: values, joined: Uint8Array.from([1, 1, 1, 1]) };

  test('begins at the fork and goes on from nothing before it', () => {
    const cut = after(series, 3);
    expect([...cut.k]).toEqual([3, 4]);
    expect([...cut.lo]).toEqual([7, 8]);
    expect(cut.lo).toBe(cut.hi);
    expect([...cut.joined]).toEqual([0, 1]);
    expect([...series.joined]).toEqual([1, 1, 1, 1]);
    expect(after(series, 0)).toBe(series);
    expect(after(series, 9).k).toHaveLength(0);
  });

  test('keeps extremes apart from values', () => {
    const cut = after({ ...series, hi: Float64Array.from([9, 9, 9, 9]) }, 2);
    expect([...cut.hi]).toEqual([9, 9, 9]);
    expect(cut.hi).not.toBe(cut.lo);
  });

  test('is there only where the branch has every signal of the line', () => {
    const source = { byName: new Map([['a', { id: 0 } as never]]) };
    expect(drawnBy({ signal: 'a' }, source)).toBe(true);
    expect(drawnBy({ signal: 'a', minus: 'b' }, source)).toBe(false);
    expect(drawnBy({ signal: 'c' }, source)).toBe(false);
  });
});
