import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Samples, Signal } from '../api/types';
import { Ring } from './ring';
import { framesOf, Source } from './source';

const signals: Signal[] = ['a', 'b'].map((name, id) => ({ id, name, unit: '', kind: 'scalar' }));

function answer(query: { signals: string; from: number; to: number; points: number }): Samples {
  const k = Array.from({ length: query.to - query.from + 1 }, (_, i) => query.from + i);
  return { k, series: query.signals.split(',').map((id) => ({ signal: signals[Number(id)]!.name, v: k.map((tick) => tick * 10 + Number(id)) })) };
}

describe('where samples come from', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it('the ring, as far as it reaches, without a call', () => {
    const fetchSamples = vi.fn(async (query: Parameters<typeof answer>[0]) => answer(query));
    const source = new Source('1', signals, () => {}, fetchSamples);
    const ring = new Ring([0], 100);
    for (let k = 50; k < 60; k++) ring.push({ k, t: k, n: 1, v: Float64Array.of(k) });
    source.rings = [ring];
    source.head = 59;
    expect([...source.get('a', 55, 59).k]).toEqual([54, 55, 56, 57, 58, 59]);
    vi.advanceTimersByTime(1000);
    expect(fetchSamples).not.toHaveBeenCalled();
  });

  it('the log, for what is older; asked once for all panels; the newer part still from the ring', async () => {
    const fetchSamples = vi.fn(async (query: Parameters<typeof answer>[0]) => answer(query));
    const changed = vi.fn();
    const source = new Source('1', signals, changed, fetchSamples);
    const ring = new Ring([0], 100);
    for (let k = 50; k < 60; k++) ring.push({ k, t: k, n: 1, v: Float64Array.of(1) });
    source.rings = [ring];
    source.head = 59;
    expect([...source.get('a', 0, 59).k]).toEqual([50, 51, 52, 53, 54, 55, 56, 57, 58, 59]);
    expect(source.get('b', 0, 59).k).toHaveLength(0);
    await vi.advanceTimersByTimeAsync(100);
    expect(fetchSamples).toHaveBeenCalledTimes(1);
    expect(fetchSamples.mock.calls[0]![0]).toMatchObject({ signals: '0,1', from: 0, to: 59 });
    expect(changed).toHaveBeenCalled();
    const all = source.get('a', 0, 59);
    expect(all.k).toHaveLength(60);
    expect([all.lo[49], all.lo[50]]).toEqual([490, 1]);
    expect(source.get('b', 0, 59).lo[59]).toBe(591);
    source.close();
  });

  it('every tick of a wide window for what is made of two signals; of a run that goes on its extremes', async () => {
    const fetchSamples = vi.fn(async (query: Parameters<typeof answer>[0]) => answer(query));
    const source = new Source('1', signals, () => {}, fetchSamples);
    source.head = 9999;
    source.exact('a', 0, 9999);
    await vi.advanceTimersByTimeAsync(100);
    expect(source.exact('a', 0, 9999).k).toHaveLength(10_000);
    expect(fetchSamples.mock.calls[0]![0].points).toBeGreaterThan(10_000);
    source.growing = true;
    source.exact('b', 0, 9999);
    await vi.advanceTimersByTimeAsync(2000);
    expect(fetchSamples.mock.calls.at(-1)![0].points).toBeLessThan(10_000);
    // Beside a signal that no stream carries its partner comes from the log, too.
    const ring = new Ring([0], 100);
    for (let k = 9990; k < 10_000; k++) ring.push({ k, t: k, n: 1, v: Float64Array.of(-1) });
    source.rings = [ring];
    source.logged('b', 9990, 9999);
    await vi.advanceTimersByTimeAsync(2000);
    expect([...source.logged('a', 9990, 9999).k]).toEqual([...source.logged('b', 9990, 9999).k]);
    expect(source.logged('a', 9990, 9999).lo.at(-1)).toBe(99_990);
    source.close();
  });

  it('every tick about a cursor, however wide the window: neither drives the other away', async () => {
    const fetchSamples = vi.fn(async (query: Parameters<typeof answer>[0]) => answer(query));
    const source = new Source('1', signals, () => {}, fetchSamples);
    source.head = 9999;
    for (let i = 0; i < 20; i++) {
      source.get('a', 0, 9999);
      source.near('a', 4999, 5000);
      await vi.advanceTimersByTimeAsync(100);
    }
    expect(fetchSamples.mock.calls.map(([query]) => [query.from, query.to])).toEqual([
      [0, 9999],
      [4992, 5056],
    ]);
    expect(source.get('a', 0, 9999).k.length).toBe(10_000);
    expect(source.near('a', 4999, 5000).k.length).toBe(65);
    source.close();
  });

  it('places far apart, and ways up to one of them, each asked for once however often they are drawn', async () => {
    const fetchSamples = vi.fn(async (query: Parameters<typeof answer>[0]) => answer(query));
    const source = new Source('1', signals, () => {}, fetchSamples);
    source.head = 9999;
    for (let i = 0; i < 20; i++) {
      source.near('a', 750, 800);
      source.near('b', 799, 800);
      source.near('a', 9998, 9999);
      await vi.advanceTimersByTimeAsync(100);
    }
    expect(fetchSamples.mock.calls.map(([query]) => [query.from, query.to]).sort()).toEqual([
      [704, 832],
      [9984, 9999],
    ]);
    expect(source.near('a', 750, 800).lo[0]).toBe(7040);
    expect(source.near('b', 799, 800).lo[0]).toBe(7041);
    expect(source.near('a', 9998, 9999).lo[0]).toBe(99_840);
    source.close();
  });

  it('nowhere, for a signal that there is not', () => {
    const source = new Source('1', signals, () => {}, async (query) => answer(query));
    expect(source.get('c', 0, 10).k).toHaveLength(0);
  });

  it('keeps the reason of a failed call', async () => {
    const source = new Source('1', signals, () => {}, async () => Promise.reject(new Error('broken')));
    source.head = 5;
    source.get('a', 0, 5);
    await vi.advanceTimersByTimeAsync(2000);
    expect(source.failure).toEqual(new Error('broken'));
    source.close();
  });

  it('the stamp of a held window does not move with ticks beyond it', () => {
    const source = new Source('1', signals);
    source.head = 100;
    const before = source.stamp(50);
    source.head = 200;
    expect(source.stamp(50)).toBe(before);
    source.inserted();
    expect(source.stamp(50)).not.toBe(before);
  });

  it('makes rows of answers that each hold some columns', () => {
    const part = (name: string, v: (number | null)[]): Samples => ({ k: [3, 4], series: [{ signal: name, v }] });
    const rows = framesOf([part('a', [1, null]), part('b', [5, 6])], [['a'], ['b']], 2);
    expect(rows.map((row) => [row.k, row.n, ...row.v])).toEqual([
      [3, 1, 1, 5],
      [4, 1, NaN, 6],
    ]);
  });
});
