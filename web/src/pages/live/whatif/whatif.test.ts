import { describe, expect, it } from 'vitest';
import { Evaluation, seriesOf } from './evaluation';
import { longestStepFlag, ThresholdRule, type RuleSettings } from './rule';
import { Score } from './score';
import { changesText, kept, readChanges, within } from './whatif.svelte';

const settings = (changes: Partial<RuleSettings>): RuleSettings => ({ rule: 'printed', tau: 3, eta: 1, iota: 0, deadBand: 'held', level: 1, ...changes });

function judge(values: readonly number[], changes: Partial<RuleSettings>): { flags: number[]; thresholds: number[] } {
  const rule = new ThresholdRule(settings(changes));
  const flags: number[] = [];
  const thresholds: number[] = [];
  for (const value of values) {
    flags.push(rule.judge(value) ? 1 : 0);
    thresholds.push(rule.threshold);
  }
  return { flags, thresholds };
}

describe('the printed threshold', () => {
  it('is mean + eta std of the last tau, this one included', () => {
    // 1, 2, 3: mean 2, std 1. Then 2, 3, 7: mean 4, std sqrt(7). Then 3, 7, 2: the same three numbers in another order.
    const { flags, thresholds } = judge([1, 2, 3, 7, 2], { eta: 1 });
    expect(thresholds.slice(0, 2)).toEqual([NaN, NaN]);
    expect(thresholds[2]).toBeCloseTo(3, 14);
    expect(thresholds[3]).toBeCloseTo(4 + Math.sqrt(7), 13);
    expect(thresholds[4]).toBeCloseTo(4 + Math.sqrt(7), 13);
    expect(flags).toEqual([0, 0, 0, 1, 0]);
  });

  it('flags what is strictly above it: equal is not', () => {
    expect(judge([1, 2, 3], { eta: 1 }).flags[2]).toBe(0);
    expect(judge([5, 5, 5, 5], { eta: 0 }).flags).toEqual([0, 0, 0, 0]);
  });

  // Specification, section 5: samples that a lasting step stays flagged.
  it.each([
    [10, 2, 1],
    [15, 2, 2],
    [20, 2, 3],
    [25, 2, 4],
    [40, 2, 7],
    [10, 3, 0],
    [15, 3, 1],
    [20, 3, 1],
    [25, 3, 2],
    [40, 3, 3],
  ])('contaminates itself: tau %i, eta %i flags a step for %i samples', (tau, eta, samples) => {
    const values = [...Array<number>(tau + 5).fill(1), ...Array<number>(2 * tau).fill(2.5)];
    const { flags } = judge(values, { tau, eta });
    expect(flags.slice(0, tau + 5)).not.toContain(1);
    expect(flags.slice(tau + 5).join('')).toBe('1'.repeat(samples) + '0'.repeat(2 * tau - samples));
    expect(longestStepFlag(tau, eta)).toBe(samples);
  });

  it('keeps the threshold inside the dead-band, and compares with the held one or with the last candidate', () => {
    const ramp = Array.from({ length: 12 }, (_, i) => i);
    const held = judge(ramp, { eta: 0, iota: 2.5 }).thresholds;
    // Candidates 1, 2, 3, …: the held one moves as soon as it is 2.5 behind.
    expect(held.slice(2)).toEqual([1, 1, 1, 4, 4, 4, 7, 7, 7, 10]);
    // Steps of 1 never reach 2.5: it stays behind for ever.
    expect(judge(ramp, { eta: 0, iota: 2.5, deadBand: 'raw_step' }).thresholds.slice(2)).toEqual(Array(10).fill(1));
    expect(judge(ramp, { eta: 0, iota: 1, deadBand: 'raw_step' }).thresholds.at(-1)).toBe(10);
  });
});

describe('the frozen threshold', () => {
  it('learns from unflagged statistics before this one only, and holds while flagged', () => {
    // Three to learn from; 1, 2, 3 give 3 at the fourth. 10 is flagged, 3 follows and is judged by the threshold held.
    const { flags, thresholds } = judge([1, 2, 3, 10, 10, 10, 3, 3], { rule: 'frozen' });
    expect(flags).toEqual([0, 0, 0, 1, 1, 1, 0, 0]);
    expect(thresholds.slice(0, 3)).toEqual([NaN, NaN, NaN]);
    expect(thresholds[3]).toBeCloseTo(3, 14);
    expect(thresholds[6]).toBe(thresholds[3]);
    // Now 2, 3, 3 are its last three unflagged ones.
    expect(thresholds[7]).toBeCloseTo(8 / 3 + Math.sqrt(1 / 3), 13);
  });

  it('flags a lasting step to its end', () => {
    const { flags } = judge([...Array<number>(20).fill(1), ...Array<number>(300).fill(1.1)], { rule: 'frozen', tau: 15, eta: 2 });
    expect(flags.reduce((sum, flag) => sum + flag, 0)).toBe(300);
  });
});

describe('a fixed level', () => {
  it('is there from the start', () => {
    expect(judge([0.5, 1, 1.01], { rule: 'fixed', level: 1 })).toEqual({ flags: [0, 0, 1], thresholds: [1, 1, 1] });
  });
});

describe('a missing statistic', () => {
  it('moves nothing and is never flagged', () => {
    const whole = judge([1, 2, 3, 7, 2], {});
    const rule = new ThresholdRule(settings({}));
    const flags = [1, 2, 3, NaN, 7, NaN, 2].map((value) => rule.judge(value));
    expect(flags).toEqual([false, false, false, false, true, false, false]);
    expect(rule.threshold).toBe(whole.thresholds[4]);
  });
});

describe('rates', () => {
  const score = (pairs: readonly (readonly [number, boolean, boolean])[], from = 5, tail = 2): Score => {
    const made = new Score(from, tail);
    for (const [k, attacked, flagged] of pairs) made.note(k, attacked, flagged);
    return made;
  };
  const ticks = (flags: string, attacks: string): [number, boolean, boolean][] => [...flags].map((flag, i) => [i + 1, attacks[i] === '1', flag === '1']);

  it('count as section 6 says', () => {
    // Ticks 1..16; attack 8..11; counted as quiet: 5..7 and, after a tail of two, 14..16.
    const { rates } = score(ticks('0100010011100011', '0000000111100000'));
    expect(rates.tpr).toBe(3 / 4);
    // Flags outside: 2 (too early), 6, 15, 16.
    expect(rates.fpr).toBe(3 / 6);
    // Wrong: 2, 6, 8, 15, 16.
    expect(rates.accuracy).toBe(11 / 16);
    expect(rates.delay).toBe(1);
    expect(rates.longest).toBe(3);
    expect(rates.quiet).toBe(12 / 16);
  });

  it('leave out the tail for the false alarms, not for the accuracy', () => {
    const { rates } = score(ticks('0000000011', '0000000100'), 1, 2);
    expect(rates.fpr).toBe(0);
    expect(rates.accuracy).toBe(7 / 10);
  });

  it('are missing where there was nothing of the kind', () => {
    expect(score([]).rates).toEqual({ tpr: null, fpr: null, accuracy: null, delay: null, longest: null, quiet: null });
    const calm = score(ticks('00000001', '00000000')).rates;
    expect(calm).toMatchObject({ tpr: null, fpr: 1 / 4, delay: null, longest: null, quiet: 1 });
    const missed = score(ticks('0000', '0011')).rates;
    expect(missed).toMatchObject({ tpr: 0, delay: null, longest: 0 });
  });

  it('take the longest flag over several attacks', () => {
    expect(score(ticks('110011100', '111011110')).rates.longest).toBe(3);
  });
});

describe('an evaluation', () => {
  const k = Array.from({ length: 60 }, (_, i) => i);
  const statistic = k.map((i) => (i < 4 ? NaN : i >= 30 && i < 40 ? 9 : 1 + (i % 3) / 10));
  const state = k.map((i) => (i >= 30 && i < 40 ? 3 : i === 0 ? NaN : 0));
  const alarm = k.map((i) => (i < 4 ? NaN : i === 25 || i === 32 || i === 33 ? 1 : 0));

  it('fed piece by piece gives what the whole gives', () => {
    const make = (): Evaluation => new Evaluation(settings({ rule: 'frozen', tau: 10, eta: 3 }), 20, 4);
    const whole = make();
    whole.feed({ k, statistic, state, alarm });
    const pieces = make();
    for (const end of [1, 7, 7, 33, 60]) pieces.feed({ k: k.slice(0, end), statistic: statistic.slice(0, end), state: state.slice(0, end), alarm: alarm.slice(0, end) });
    expect(pieces.flags).toEqual(whole.flags);
    expect(pieces.thresholds).toEqual(whole.thresholds);
    expect(pieces.rates).toEqual(whole.rates);
    expect(whole.rates).toEqual({ tpr: 1, fpr: 0, accuracy: 1, delay: 0, longest: 10, quiet: 49 / 59 });
  });

  it('knows when it cannot say, and leaves tick 0 out', () => {
    const one = new Evaluation(settings({ tau: 10 }), 20, 4);
    one.feed({ k, statistic, state, alarm });
    // The first statistic is at 4, the tenth at 13.
    expect(one.flags.findIndex((flag) => !Number.isNaN(flag))).toBe(13);
    const short = new Evaluation(settings({ rule: 'fixed', level: 1 }), 0, 0);
    short.feed({ k: [0, 1], statistic: [5, 5], state: [NaN, 3], alarm: [NaN, 0] });
    expect(short.rates.accuracy).toBe(1);
    expect(short.rates.quiet).toBe(0);
    expect(short.ownRates.accuracy).toBe(0);
  });

  it('scores the lane’s own flags over the same ticks', () => {
    const one = new Evaluation(settings({}), 20, 4);
    one.feed({ k, statistic, state, alarm });
    // Quiet: 20 to 29 and, after a tail of four, 44 to 59.
    expect(one.ownRates).toEqual({ tpr: 0.2, fpr: 1 / 26, accuracy: 50 / 59, delay: 2, longest: 2, quiet: 49 / 59 });
  });
});

describe('changes in the address', () => {
  it('are written and read, whatever somebody typed', () => {
    expect(changesText({ rule: 'frozen', tau: 40 })).toBe('rule:frozen,tau:40');
    expect(changesText({})).toBeNull();
    expect(readChanges('rule:frozen,tau:40,eta:2.5')).toEqual({ rule: 'frozen', tau: 40, eta: 2.5 });
    expect(readChanges('rule:magic,tau:0,eta:x,iota:-3,level:,constructor:1')).toEqual({ tau: 2, iota: 0 });
    expect(readChanges(null)).toEqual({});
    expect(kept('tau', 12.6)).toBe(13);
  });
});

describe('the part in the window', () => {
  it('has a point more on both sides', () => {
    const series = seriesOf([0, 1, 2, 3, 4, 5], [0, 10, 20, 30, 40, 50]);
    const part = within(series, 2, 3);
    expect([...part.k]).toEqual([1, 2, 3, 4]);
    expect([...part.hi]).toEqual([10, 20, 30, 40]);
    expect([...within(series, -5, 99).k]).toEqual([0, 1, 2, 3, 4, 5]);
    expect(within(seriesOf([], []), 0, 9).k).toHaveLength(0);
  });
  it('joins nothing over missing ticks', () => {
    expect([...seriesOf([0, 1, 5], [1, 1, 1]).joined]).toEqual([0, 1, 0]);
    expect([...seriesOf([0, 5, 10], [1, 1, 1], 5).joined]).toEqual([0, 1, 1]);
  });
});
