import { describe, expect, it, vi } from 'vitest';
import type { Samples } from '../../api/types';
import { History, mostTicks } from './history.svelte';

const byName = new Map([['a', { id: 7 }], ['b', { id: 9 }]]);

function bench(head: number) {
  const source = { head, byName };
  const fetch = vi.fn((_run: string, { from, to }: { from: number; to: number }): Promise<Samples> => {
    const k = Array.from({ length: to - from + 1 }, (_, i) => from + i);
    return Promise.resolve({ k, series: [{ signal: 'a', v: k.map((tick) => tick / 3) }, { signal: 'b', v: k.map((tick) => (tick ? 1 : null)) }] });
  });
  return { source, fetch, history: new History({ id: '5', source }, ['a', 'b'], fetch) };
}

describe('a history', () => {
  it('has every tick at full precision, missing ones as NaN', async () => {
    const { history, fetch } = bench(2);
    await history.update();
    expect(fetch.mock.calls[0]![1]).toMatchObject({ signals: '7,9', from: 0, to: 2 });
    expect([...history.k]).toEqual([0, 1, 2]);
    expect(history.column('a')[1]).toBe(1 / 3);
    expect(history.column('b')[0]).toBeNaN();
    expect(history.whole).toBe(true);
  });

  it('reads only what came since', async () => {
    const { history, source, fetch } = bench(2);
    await history.update();
    await history.update();
    source.head = 5;
    await history.update();
    expect(fetch.mock.calls.map(([, query]) => [query.from, query.to])).toEqual([[0, 2], [3, 5]]);
    expect([...history.k]).toEqual([0, 1, 2, 3, 4, 5]);
    expect(history.version).toBe(2);
  });

  it('takes no tick twice and waits for those that the log does not have yet', async () => {
    const { source, history, fetch } = bench(4);
    fetch.mockResolvedValueOnce({ k: [0, 1], series: [{ signal: 'a', v: [0, 1] }, { signal: 'b', v: [0, 1] }] });
    await history.update();
    expect([...history.k]).toEqual([0, 1]);
    source.head = 4;
    await history.update();
    expect(fetch.mock.calls[1]![1].from).toBe(2);
    expect([...history.k]).toEqual([0, 1, 2, 3, 4]);
  });

  it('of a very long run begins with its newest ticks', async () => {
    const { history, fetch } = bench(mostTicks + 1000);
    await history.update();
    expect(fetch.mock.calls[0]![1].from).toBe(1001);
  });

  it('keeps a failure and tries again', async () => {
    const { history, fetch } = bench(1);
    fetch.mockRejectedValueOnce(new Error('no'));
    await history.update();
    expect(history.failure).toBeInstanceOf(Error);
    await history.update();
    expect(history.failure).toBeNull();
    expect(history.k).toHaveLength(2);
  });
});
