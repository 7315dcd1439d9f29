import { describe, expect, it } from 'vitest';
import { Ring } from './ring';
import { concatSeries, decimate, difference, gapsOf, ringSeries, samplesSeries, usualStep, valueAt, type Series } from './series';

function series(k: number[], v: number[], joined?: number[]): Series {
  const values = Float64Array.from(v);
  return { k: Float64Array.from(k), lo: values, hi: values, joined: Uint8Array.from(joined ?? k.map((_, i) => (i ? 1 : 0))) };
}

describe('a window of a signal', () => {
  it('reads a ring with one row more on both sides', () => {
    const ring = new Ring([0], 20);
    for (let k = 0; k < 10; k++) ring.push({ k, t: k, n: 1, v: Float64Array.of(k * k) });
    const found = ringSeries(ring, 0, 3, 5);
    expect([...found.k]).toEqual([2, 3, 4, 5, 6]);
    expect([...found.lo]).toEqual([4, 9, 16, 25, 36]);
  });

  it('takes extremes and raw values from the server, null as NaN', () => {
    const found = samplesSeries({
      k: [0, 10, 20],
      series: [
        { signal: 'a', lo: [0, null, 2], hi: [1, null, 3] },
        { signal: 'b', v: [5, 6, 7] },
      ],
    });
    expect([...found.get('a')!.hi]).toEqual([1, NaN, 3]);
    expect(found.get('b')!.lo).toBe(found.get('b')!.hi);
    expect([...found.get('b')!.joined]).toEqual([0, 1, 1]);
  });

  it('joins nothing over missing ticks, told or seen', () => {
    const seen = samplesSeries({ k: [0, 1, 2, 9, 10], series: [{ signal: 'a', v: [1, 1, 1, 1, 1] }] }).get('a')!;
    expect([...seen.joined]).toEqual([0, 1, 1, 0, 1]);
    expect(gapsOf(seen, 0, 10)).toEqual([{ from: 2, to: 9 }]);
    const told = samplesSeries({ k: [0, 10, 20], gaps: [{ from: 12, to: 14 }], series: [{ signal: 'a', lo: [1, 1, 1], hi: [1, 1, 1] }] }).get('a')!;
    expect([...told.joined]).toEqual([0, 1, 0]);
  });

  it('cuts gaps at the window', () => {
    expect(gapsOf(series([0, 50], [1, 1], [0, 0]), 20, 30)).toEqual([{ from: 20, to: 30 }]);
    expect(gapsOf(series([0, 50], [1, 1], [0, 0]), 60, 70)).toEqual([]);
  });

  it('puts newer after older without a tick twice', () => {
    const both = concatSeries(series([0, 1, 2], [0, 1, 2]), series([2, 3], [9, 3]));
    expect([...both.k]).toEqual([0, 1, 2, 3]);
    expect([...both.lo]).toEqual([0, 1, 2, 3]);
  });

  it('gives the value at a tick, and none that is too old', () => {
    const one = series([2, 4, 8], [20, 40, 80]);
    expect(valueAt(one, 5)).toBe(40);
    expect(valueAt(one, 7, 1)).toBeNaN();
    expect(valueAt(one, 1)).toBeNaN();
    expect(usualStep([0, 1, 2, 50])).toBe(1);
  });
});

describe('decimation', () => {
  it('leaves what fits', () => {
    const one = series([0, 1, 2], [1, 2, 3]);
    expect(decimate(one, 10)).toBe(one);
  });

  it('keeps a peak and a dip of a single tick, in their order', () => {
    const n = 10_000;
    const v = Array.from({ length: n }, () => 0);
    v[4321] = 100;
    v[4322] = -100;
    const out = decimate(series([...v.keys()], v), 200);
    expect(out.k.length).toBeLessThanOrEqual(402);
    expect(Math.max(...out.hi)).toBe(100);
    expect(Math.min(...out.lo)).toBe(-100);
    expect([...out.hi].indexOf(100)).toBeLessThan([...out.lo].indexOf(-100));
    for (let i = 1; i < out.k.length; i++) expect(out.k[i]!).toBeGreaterThan(out.k[i - 1]!);
  });

  it('keeps breaks', () => {
    const n = 1000;
    const joined = Array.from({ length: n }, (_, i) => (i === 0 || i === 500 ? 0 : 1));
    const out = decimate(
      series(
        Array.from({ length: n }, (_, i) => i),
        Array.from({ length: n }, (_, i) => Math.sin(i)),
        joined,
      ),
      50,
    );
    expect([...out.joined].filter((j) => j === 0)).toHaveLength(2);
  });
});

describe('a difference', () => {
  it('is taken where both have the tick', () => {
    const found = difference(series([0, 1, 2, 3], [5, 6, 7, 8]), series([1, 2, 3, 4], [1, 1, 2, 2]));
    expect([...found.k]).toEqual([1, 2, 3]);
    expect([...found.lo]).toEqual([5, 6, 6]);
    expect(found.hi).toBe(found.lo);
    expect([...found.joined]).toEqual([0, 1, 1]);
  });

  it('goes on over a tick that a thinned stream left out, and not over missing ones', () => {
    const thinned = difference(series([0, 1, 2], [1, 1, 1]), series([0, 2], [0, 0]));
    expect([[...thinned.k], [...thinned.joined]]).toEqual([[0, 2], [0, 1]]);
    const broken = difference(series([0, 1, 2, 3], [1, 1, 1, 1], [0, 1, 0, 1]), series([0, 1, 3], [0, 0, 0]));
    expect([[...broken.k], [...broken.joined]]).toEqual([[0, 1, 3], [0, 1, 0]]);
  });

  it('of extremes holds every difference that they allow', () => {
    const a: Series = { ...series([0, 10], [1, 2]), hi: Float64Array.of(3, 4) };
    const found = difference(a, series([0, 10], [1, 1]));
    expect([[...found.lo], [...found.hi]]).toEqual([[0, 1], [2, 3]]);
    expect(difference(series([], []), a).k.length).toBe(0);
  });

  it('misses what one of them misses', () => {
    expect([...difference(series([0, 1], [1, NaN]), series([0, 1], [NaN, 1])).lo]).toEqual([NaN, NaN]);
  });
});
