import { describe, expect, it } from 'vitest';
import type { LaneModel } from '../model';
import { otherLane } from './compare';
import { binsFor, errorsOf, histogramOf, smoothOf, spanOf, summaryOf } from './density';

/** Quantiles of the standard normal law: a sample without chance. */
function normal(n: number): number[] {
  // Rational approximation by Acklam is more than enough at 1e-9; here by bisection of erf's series.
  const cdf = (z: number): number => {
    let [term, sum] = [z, z];
    for (let i = 1; i < 200; i++) sum += (term *= (-z * z * (2 * i - 1)) / (2 * i * (2 * i + 1)));
    return 0.5 + sum / Math.sqrt(2 * Math.PI);
  };
  return Array.from({ length: n }, (_, i) => {
    const wanted = (i + 0.5) / n;
    let [low, high] = [-6, 6];
    for (let step = 0; step < 60; step++) {
      const middle = (low + high) / 2;
      if (cdf(middle) < wanted) low = middle;
      else high = middle;
    }
    return (low + high) / 2;
  });
}

describe('errors', () => {
  const k = [18, 19, 20, 21, 22, 23];
  it('are those from the first tick on, signed', () => {
    expect(errorsOf(k, [1, 1, 1, 2, NaN, 4], [0, 0, 2, 0, 0, 1], 20, null)).toEqual([-1, 2, 3]);
  });
  it('leave out attacked ticks where asked to', () => {
    expect(errorsOf(k, [1, 1, 1, 2, 3, 4], [0, 0, 0, 0, 0, 0], 20, [0, 0, 0, 3, 3, 0])).toEqual([1, 4]);
  });
});

describe('a summary', () => {
  it('has a spread that an outlier does not move', () => {
    const values = [...normal(201), 1000];
    const summary = summaryOf(values)!;
    expect(summary.deviation).toBeGreaterThan(60);
    expect(summary.spread).toBeCloseTo(1, 1);
    expect(summary).toMatchObject({ count: 202, most: 1000 });
    expect(summaryOf([3])).toBeNull();
    expect(summaryOf([2, 2, 2])!.spread).toBe(0);
  });
});

describe('a histogram', () => {
  it('has unit area, the last edge included', () => {
    const { density, width } = histogramOf([0, 0.5, 1, 1.5, 2], 0, 2, 4);
    expect([...density].map((value) => value * width)).toEqual([0.2, 0.2, 0.2, 0.4]);
  });
  it('keeps in its count what lies outside', () => {
    const { density, width } = histogramOf([0.5, 9], 0, 1, 1);
    expect(density[0]! * width).toBe(0.5);
  });
  it('has more bins for more values, within bounds', () => {
    const summary = summaryOf(normal(2000))!;
    expect(binsFor(summary, -4, 4)).toBeGreaterThan(binsFor({ ...summary, count: 100 }, -4, 4));
    expect(binsFor({ ...summary, spread: 0 }, -4, 4)).toBe(8);
    expect(binsFor({ ...summary, spread: 1e-9 }, -4, 4)).toBe(60);
  });
});

describe('the smooth line', () => {
  it('has unit area and comes near the law', () => {
    const values = normal(3000);
    const line = smoothOf(values, summaryOf(values)!, -6, 6, 401);
    const step = 12 / 400;
    expect([...line].reduce((sum, value) => sum + value * step, 0)).toBeCloseTo(1, 3);
    const law = (z: number): number => Math.exp((-z * z) / 2) / Math.sqrt(2 * Math.PI);
    for (const z of [-2, -1, 0, 1, 2]) expect(Math.abs(line[Math.round((z + 6) / step)]! - law(z))).toBeLessThan(0.02);
  });
  it('shows two modes as two', () => {
    const values = [...normal(400).map((z) => z / 4 - 2), ...normal(400).map((z) => z / 4 + 2)];
    const line = smoothOf(values, { ...summaryOf(values)!, spread: 0.4 }, -4, 4, 201);
    const at = (x: number): number => line[Math.round((x + 4) / 0.04)]!;
    expect(at(0)).toBeLessThan(0.2 * at(2));
    expect(at(-2)).toBeCloseTo(at(2), 6);
  });
  it('of equal values is one narrow peak, not a hole', () => {
    const line = smoothOf([1, 1, 1], summaryOf([1, 1, 1])!, 0, 2, 101);
    expect(Math.max(...line)).toBe(line[50]);
    expect(line.every(Number.isFinite)).toBe(true);
  });
});

describe('the span', () => {
  it('holds both sets, and not a far outlier alone', () => {
    const near = summaryOf(normal(101))!;
    expect(spanOf([near, summaryOf(normal(101).map((z) => z + 5))!])!.to).toBeGreaterThan(7);
    expect(spanOf([summaryOf([...normal(101), 1e6])!])!.to).toBeLessThan(2e4);
    expect(spanOf([])).toBeNull();
  });
});

describe('the lane beside', () => {
  const lane = (id: string, method: string): LaneModel => ({ id, method }) as LaneModel;
  const lanes = [lane('as_written', 'mixed_filter'), lane('repaired', 'mixed_filter'), lane('u', 'ufir_filter'), lane('z', 'zonotope_watermark')];
  it('is the one asked for, else the paper’s baseline', () => {
    expect(otherLane({ lanes }, lanes[1]!, null)?.id).toBe('z');
    expect(otherLane({ lanes }, lanes[3]!, null)?.id).toBe('u');
    expect(otherLane({ lanes }, lanes[1]!, 'as_written')?.id).toBe('as_written');
    expect(otherLane({ lanes }, lanes[1]!, 'repaired')?.id).toBe('z');
    expect(otherLane({ lanes }, lanes[1]!, 'none')).toBeNull();
    expect(otherLane({ lanes: [lanes[0]!] }, lanes[0]!, null)).toBeNull();
  });
});
