import { describe, expect, it } from 'vitest';
import { emptySeries, type Series } from '../data/series';
import { packed } from './colours';
import { kOf, moved, xOf, zoomed, type Geometry } from './geometry';
import { tableOf } from './held_chart';
import { columnsOf, rowSpans, ticksPerColumn } from './raster';
import { extent, fit, fraction, outside, scaleTicks, tickLabel, ticks } from './scale';

function series(k: number[], lo: number[], hi?: number[]): Series {
  const low = Float64Array.from(lo);
  return { k: Float64Array.from(k), lo: low, hi: hi ? Float64Array.from(hi) : low, joined: Uint8Array.from(k.map((_, i) => (i ? 1 : 0))) };
}
const g: Geometry = { width: 252, height: 100, left: 44, right: 8, top: 4, bottom: 18, from: 0, to: 100 };

describe('geometry', () => {
  it('goes from tick to pixel and back', () => {
    expect(xOf(g, 0)).toBe(44);
    expect(xOf(g, 100)).toBe(244);
    expect(kOf(g, xOf(g, 37))).toBeCloseTo(37);
  });

  it('zooms about a tick and stays inside the run', () => {
    expect(zoomed(100, 200, 0.5, 150, 1000)).toEqual({ from: 125, to: 175 });
    expect(zoomed(0, 100, 0.5, 0, 1000)).toEqual({ from: 0, to: 50 });
    expect(zoomed(0, 100, 100, 50, 300)).toEqual({ from: 0, to: 300 });
    expect(zoomed(10, 14, 0.1, 12, 300)).toEqual({ from: 10, to: 14 });
    expect(moved(250, 300, 100, 300)).toEqual({ from: 250, to: 300 });
    expect(moved(5, 15, -100, 300)).toEqual({ from: 0, to: 10 });
  });
});

describe('scales', () => {
  it('take in every value of the window only', () => {
    expect(extent([series([0, 1, 2], [5, -3, 100])], 0, 1, false)).toEqual({ lo: -3, hi: 5 });
    expect(extent([series([0, 1], [0, 2], [4, 8])], 0, 1, true)).toEqual({ lo: 2, hi: 8 });
    expect(extent([series([0], [NaN])], 0, 1, false)).toBeNull();
    expect(extent([emptySeries], 0, 1, true)).toBeNull();
  });

  it('hold what they were fitted to', () => {
    for (const values of [{ lo: 0.13, hi: 38 }, { lo: 5, hi: 5 }, { lo: 1e-9, hi: 1e26 }]) {
      for (const log of [true, false]) {
        const scale = fit(values, log);
        expect(outside(scale, values.lo)).toBe(false);
        expect(outside(scale, values.hi)).toBe(false);
        expect(fraction(scale, values.lo)).toBeGreaterThanOrEqual(0);
        expect(fraction(scale, values.hi)).toBeLessThanOrEqual(1);
      }
    }
  });

  it('have no place for 0 when logarithmic, and do not call it outside', () => {
    const scale = fit({ lo: 1, hi: 10 }, true);
    expect(fraction(scale, 0)).toBeNaN();
    expect(outside(scale, 0)).toBe(false);
    expect(outside(scale, 1e9)).toBe(true);
  });

  it('are symmetric and logarithmic about a linear middle where errors have a sign', () => {
    const scale = fit({ lo: -0.004, hi: 8 }, false, 0.01);
    expect(scale).toEqual({ log: false, middle: 0.01, lo: -0.01, hi: 10 });
    expect(fraction(scale, -0.01)).toBeCloseTo(0);
    expect(fraction(scale, 10)).toBeCloseTo(1);
    // Equal factors far out are equal ways; near 0 equal differences are.
    expect(fraction(scale, 10) - fraction(scale, 1)).toBeCloseTo(fraction(scale, 1) - fraction(scale, 0.1), 2);
    expect(fraction(scale, 0.002) - fraction(scale, 0.001)).toBeCloseTo(fraction(scale, 0.001) - fraction(scale, 0), 3);
    expect(outside(scale, 11)).toBe(true);
    expect(outside(scale, -0.02)).toBe(true);
    expect(outside(scale, -0.009)).toBe(false);
    expect(fit(null, false, 0.01)).toEqual({ log: false, middle: 0.01, lo: -0.01, hi: 0.01 });
    expect(fit({ lo: 2, hi: 3 }, false, 0.01).lo).toBe(-0.01);
  });

  it('have ticks at 0 and powers of ten that do not crowd', () => {
    const scale = fit({ lo: -20, hi: 8 }, false, 0.01);
    expect(scaleTicks(scale, 20)).toEqual([-10, -1, -0.1, -0.01, 0, 0.01, 0.1, 1, 10]);
    const few = scaleTicks(scale, 4);
    expect(few).toContain(0);
    const places = few.map((value) => fraction(scale, value));
    for (let i = 1; i < places.length; i++) expect(places[i]! - places[i - 1]!).toBeGreaterThanOrEqual(0.25);
  });

  it('have round ticks', () => {
    expect(ticks(0, 100, 5)).toEqual([0, 20, 40, 60, 80, 100]);
    expect(ticks(3, 3, 5)).toEqual([]);
    expect(scaleTicks({ log: true, lo: 0.05, hi: 200 }, 10)).toEqual([0.1, 1, 10, 100]);
    expect([0, 0.1, 25, 100000, 3e-7].map(tickLabel)).toEqual(['0', '0.1', '25', '10⁵', '3·10⁻⁷']);
  });
});

describe('rasters', () => {
  it('put a tick into its column, once', () => {
    expect([...columnsOf(series([2, 3, 4], [1, 0, 2]), 0, 1, 6)]).toEqual([NaN, NaN, 1, 0, 2, NaN]);
  });

  it('show the worst of several ticks in one column', () => {
    const one = series([0, 1, 2, 3], [0, 2, 1, 0]);
    expect([...columnsOf(one, 0, 2, 2)]).toEqual([2, 1]);
    expect([...columnsOf(one, 0, 2, 2, true)]).toEqual([0, 0]);
  });

  it('fill the columns that a reduced point stands for, with its own extreme', () => {
    const one = series([0, 4, 8], [0, 0, 0], [1, 2, 0]);
    expect([...columnsOf(one, 0, 1, 9)]).toEqual([1, 1, 1, 1, 2, 2, 2, 2, 0]);
    expect([...columnsOf(one, 0, 1, 9, true)]).toEqual([0, 0, 0, 0, 0, 0, 0, 0, 0]);
  });

  it('give the ticks that a thinned frame stands for its value, and missing ticks none', () => {
    const one = { ...series([0, 3, 6], [1, 2, 1]), joined: Uint8Array.of(0, 1, 0) };
    expect([...columnsOf(one, 0, 1, 7)]).toEqual([1, 2, 2, 2, NaN, NaN, 1]);
  });

  it('leave missing values and what is outside empty', () => {
    expect([...columnsOf({ ...series([-3, 1, 99], [1, NaN, 1]), joined: Uint8Array.of(0, 0, 0) }, 0, 1, 3)]).toEqual([NaN, NaN, NaN]);
  });

  it('keep cells at least two pixels wide', () => {
    expect(ticksPerColumn(g)).toBe(1);
    expect(ticksPerColumn({ ...g, to: 1000 })).toBe(10);
  });

  it('fill the height with rows of their weights', () => {
    const spans = rowSpans({ ...g, top: 0, bottom: 0, height: 90 }, [{ weight: 1 }, { weight: 2 }]);
    expect(spans).toEqual([
      { y: 0, height: 29 },
      { y: 30, height: 59 },
    ]);
  });

  it('write colours as an image has them', () => {
    expect(packed('#c4501b')).toBe(0xff1b50c4);
    expect(packed('#fff')).toBe(packed('#ffffff'));
    expect(packed('#1af')).toBe(packed('#11aaff'));
  });
});

describe('the still chart', () => {
  it('breaks the line where ticks are missing or a value is none', () => {
    const one = { ...series([0, 1, 5, 6], [1, 2, 3, NaN]), joined: Uint8Array.of(0, 1, 0, 1) };
    expect(tableOf(one, false)).toEqual([
      [0, 1, 3, 5, 6],
      [1, 2, null, 3, null],
    ]);
    expect(tableOf(series([0, 1], [0, 5]), true)[1]).toEqual([null, 5]);
  });

  it('draws both extremes of a bucket', () => {
    expect(tableOf(series([0, 10], [1, 2], [3, 4]), false)).toEqual([
      [0, 5, 10, 10.5],
      [1, 3, 2, 4],
    ]);
  });
});
