import { describe, expect, it } from 'vitest';
import type { RunItem } from '../../../api/types';
import { freeSeeds, meanOf, runningMean, trialsOf, valuesOf } from './trials';
import { meanSpan } from './trials_draw';

const run = (id: number, seed: number, changes: Partial<RunItem> = {}): RunItem =>
  ({ id: String(id), seed, state: 'finished', document_hash: 'h', changes: 0, input: 'simulate', metrics: [{ lane: 'a', node: null, name: 'accuracy', variant: null, value: seed / 10 }], ...changes }) as RunItem;

describe('runs in this log', () => {
  it('are those of the very same document, to their end and left alone, one a seed, oldest first', () => {
    const runs = [
      run(12, 3), run(9, 1), run(10, 2), run(11, 2),
      run(1, 4, { document_hash: 'other' }), run(2, 5, { state: 'stopped' }), run(3, 6, { changes: 1 }), run(4, 7, { input: { trace: '1' } }), run(5, 8, { document_hash: undefined }),
    ];
    expect(trialsOf(runs, 'h').map(({ id }) => id)).toEqual(['9', '10', '12']);
  });

  it('give the values that they have', () => {
    const runs = [run(1, 1), run(2, 2, { metrics: [] }), run(3, 3)];
    expect(valuesOf(runs, 'a', 'accuracy')).toEqual([0.1, 0.3]);
    expect(valuesOf(runs, 'b', 'accuracy')).toEqual([]);
  });

  it('average as they come', () => {
    expect(runningMean([1, 0, 0.5])).toEqual([1, 0.5, 0.5]);
    expect(meanOf([1, 2, 3, 4])).toEqual({ mean: 2.5, error: Math.sqrt(5 / 3 / 4), count: 4 });
    expect(meanOf([2])).toEqual({ mean: 2, error: null, count: 1 });
    expect(meanOf([])).toEqual({ mean: null, error: null, count: 0 });
  });

  it('are made with seeds that nobody has', () => {
    expect(freeSeeds([1, 2, 4], 4)).toEqual([3, 5, 6, 7]);
  });

  it('are drawn between 0 and 1, with what saying nothing would reach', () => {
    const line = (values: number[]) => ({ token: 'ink', dash: [], width: 1, values });
    expect(meanSpan([line([0.99, 1])], 0.73)).toEqual({ lo: 0.73 - 0.08 * 0.27, hi: 1 });
    expect(meanSpan([], null)).toEqual({ lo: 0, hi: 1 });
  });
});
