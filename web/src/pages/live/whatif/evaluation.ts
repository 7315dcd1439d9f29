/// Flags and rates of a recorded statistic under settings of one's own. It can be fed as the run grows.
import type { Series } from '../../../data/series';
import { ThresholdRule, type RuleSettings } from './rule';
import { Score, type Rates } from './score';

export interface Recorded {
  k: readonly number[];
  statistic: readonly number[];
  /** Above zero: attacked. */
  state: readonly number[];
  /** What the lane itself said: above zero where it flagged. */
  alarm: readonly number[];
}

export class Evaluation {
  readonly k: number[] = [];
  readonly thresholds: number[] = [];
  /** 1 flagged, 0 not, NaN: it cannot say. */
  readonly flags: number[] = [];
  private readonly rule: ThresholdRule;
  private readonly score: Score;
  private readonly own: Score;

  constructor(settings: RuleSettings, from: number, tail: number) {
    this.rule = new ThresholdRule(settings);
    this.score = new Score(from, tail);
    this.own = new Score(from, tail);
  }

  /** Takes what the record has beyond what it took already. Tick 0 is the start: nothing was received yet. */
  feed({ k, statistic, state, alarm }: Recorded): void {
    for (let i = this.k.length; i < k.length; i++) {
      const value = statistic[i]!;
      const flagged = this.rule.judge(value);
      this.k.push(k[i]!);
      this.thresholds.push(this.rule.threshold);
      this.flags.push(Number.isNaN(value) || Number.isNaN(this.rule.threshold) ? NaN : flagged ? 1 : 0);
      if (!(k[i]! > 0)) continue;
      this.score.note(k[i]!, state[i]! > 0, flagged);
      this.own.note(k[i]!, state[i]! > 0, alarm[i]! > 0);
    }
  }

  get rates(): Rates {
    return this.score.rates;
  }

  /** Of the lane's own flags over the same ticks. */
  get ownRates(): Rates {
    return this.own.rates;
  }
}

/** Columns of a record as a series for the pictures. Ticks that do not follow each other by `step` are not joined. */
export function seriesOf(k: readonly number[], values: readonly number[], step = 1): Series {
  const lo = Float64Array.from(values);
  return { k: Float64Array.from(k), lo, hi: lo, joined: Uint8Array.from(k, (tick, i) => (i > 0 && tick - k[i - 1]! <= step ? 1 : 0)) };
}
