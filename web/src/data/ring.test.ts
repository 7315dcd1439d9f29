import { describe, expect, it } from 'vitest';
import type { Frame } from '../stream/events';
import { Ring } from './ring';

const frame = (k: number, value = k, n = 1): Frame => ({ k, t: k / 10, n, v: Float64Array.of(value, -value) });

describe('the ring of newest frames', () => {
  it('keeps the newest and forgets the oldest', () => {
    const ring = new Ring([7, 9], 4);
    for (let k = 0; k < 10; k++) ring.push(frame(k));
    expect(ring.length).toBe(4);
    expect([0, 1, 2, 3].map((i) => ring.tick(i))).toEqual([6, 7, 8, 9]);
    expect(ring.value(1, 0)).toBe(-6);
    expect(ring.time(3)).toBeCloseTo(0.9);
    expect([ring.first, ring.last]).toEqual([6, 9]);
  });

  it('takes no frame twice: a resume may repeat the last', () => {
    const ring = new Ring([0, 1], 4);
    expect(ring.push(frame(3))).toBe(true);
    expect(ring.push(frame(3, 99))).toBe(false);
    expect(ring.push(frame(2))).toBe(false);
    expect(ring.length).toBe(1);
    expect(ring.value(0, 0)).toBe(3);
  });

  it('knows missing ticks from ticks that a thinned frame stands for', () => {
    const ring = new Ring([0, 1], 10);
    ring.push(frame(1));
    ring.push(frame(5, 5, 4));
    ring.push(frame(9, 9, 2));
    expect([1, 2].map((i) => ring.joined(i))).toEqual([true, false]);
    expect(ring.first).toBe(1);
  });

  it('closes a gap when its fill comes, and keeps what it knew', () => {
    const ring = new Ring([0, 1], 10);
    ring.push(frame(1));
    ring.push(frame(4));
    ring.insert([frame(2), frame(3), frame(4, 99)]);
    expect([0, 1, 2, 3].map((i) => ring.tick(i))).toEqual([1, 2, 3, 4]);
    expect(ring.joined(3)).toBe(true);
    expect(ring.value(0, 3)).toBe(4);
  });

  it('finds rows by tick, also after it has wrapped', () => {
    const ring = new Ring([0, 1], 5);
    for (let k = 0; k < 20; k += 2) ring.push(frame(k, k, 2));
    expect(ring.lower(11)).toBe(1);
    expect(ring.lower(12)).toBe(1);
    expect(ring.lower(99)).toBe(5);
    expect(ring.lower(-1)).toBe(0);
  });

  it('says of nothing that it has nothing', () => {
    const ring = new Ring([0], 5);
    expect(ring.first).toBeNaN();
    expect(ring.last).toBeNaN();
    expect(ring.lower(3)).toBe(0);
  });
});
