import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { paced } from './paced';

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

test('the last call of many acts, however soon it comes after one that did', () => {
  let value = 0;
  const seen: number[] = [];
  const { call } = paced(100, () => seen.push(value), Date.now);
  call();
  value = 1;
  vi.advanceTimersByTime(20);
  call();
  value = 2;
  call();
  expect(seen).toEqual([0]);
  vi.advanceTimersByTime(81);
  expect(seen).toEqual([0, 2]);
  vi.advanceTimersByTime(1000);
  expect(seen, 'nobody called since').toEqual([0, 2]);
});

test('what must not wait acts at once and takes what waited with it', () => {
  let acts = 0;
  const { call } = paced(100, () => acts++, Date.now);
  call();
  call();
  call(true);
  expect(acts).toBe(2);
  vi.advanceTimersByTime(1000);
  expect(acts).toBe(2);
});

test('nothing acts after the stop', () => {
  let acts = 0;
  const { call, stop } = paced(100, () => acts++, Date.now);
  call();
  call();
  stop();
  vi.advanceTimersByTime(1000);
  expect(acts).toBe(1);
});
