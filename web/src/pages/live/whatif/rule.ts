/// A statistic against a threshold, tick by tick (specification of seed 003, section 5; seed 003, eqs. (27)-(28)).
///
/// The same arithmetic as the engine's detector, in the same order: with a lane's own settings it gives the lane's own flags.

/** printed: mean + eta std of the last tau statistics, this one included. frozen: of the last tau unflagged ones before it, held while flagged. fixed: a level. */
export type Rule = 'printed' | 'frozen' | 'fixed';

export interface RuleSettings {
  rule: Rule;
  /** Threshold window, statistics; at least 2. */
  tau: number;
  /** Standard deviations above the mean; not below 0. */
  eta: number;
  /** Dead-band in units of the statistic; not below 0. */
  iota: number;
  /** What a new candidate is compared with: the threshold held, or the candidate before it. */
  deadBand: 'held' | 'raw_step';
  /** The threshold of rule `fixed`. */
  level: number;
}

/** The last so many values, in no order. */
class Window {
  private readonly values: Float64Array;
  private next = 0;
  private count = 0;

  constructor(size: number) {
    this.values = new Float64Array(size);
  }

  get full(): boolean {
    return this.count === this.values.length;
  }

  push(value: number): void {
    this.values[this.next] = value;
    this.next = this.next + 1 === this.values.length ? 0 : this.next + 1;
    this.count = Math.min(this.count + 1, this.values.length);
  }

  /** Mean + eta standard deviations, in two passes: a running sum of squares cancels where the statistic hardly changes. */
  candidate(eta: number): number {
    const size = this.values.length;
    let sum = 0;
    for (const value of this.values) sum += value;
    const first = sum / size;
    let rest = 0;
    for (const value of this.values) rest += value - first;
    const mean = first + rest / size;
    let squares = 0;
    for (const value of this.values) squares += (value - mean) * (value - mean);
    return mean + eta * Math.sqrt(squares / (size - 1));
  }
}

export class ThresholdRule {
  /** NaN: none yet. */
  threshold: number;
  flagged = false;
  private readonly window: Window;
  private last = NaN;

  constructor(private readonly settings: RuleSettings) {
    this.window = new Window(settings.tau);
    this.threshold = settings.rule === 'fixed' ? settings.level : NaN;
  }

  /** Whether the next statistic is flagged. One that is missing moves nothing and is not flagged. */
  judge(statistic: number): boolean {
    if (Number.isNaN(statistic)) return false;
    const { rule } = this.settings;
    if (rule === 'printed') this.window.push(statistic);
    if (rule !== 'fixed') this.follow();
    this.flagged = statistic > this.threshold;
    if (rule === 'frozen' && !this.flagged) this.window.push(statistic);
    return this.flagged;
  }

  private follow(): void {
    const { rule, eta, iota, deadBand } = this.settings;
    if (!this.window.full || (rule === 'frozen' && this.flagged)) return;
    const next = this.window.candidate(eta);
    const before = deadBand === 'held' ? this.threshold : this.last;
    if (Number.isNaN(this.threshold) || Math.abs(next - before) >= iota) this.threshold = next;
    this.last = next;
  }
}

/** For how many samples the printed threshold flags a lasting step, dead-band zero: the largest whole q below tau / (1 + eta^2 tau / (tau - 1)). */
export function longestStepFlag(tau: number, eta: number): number {
  return Math.ceil(tau / (1 + (eta * eta * tau) / (tau - 1))) - 1;
}
