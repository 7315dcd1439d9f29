/// One run's what-if: settings of one's own, and what they would have made of the recorded statistic. Kept in the address; the run knows nothing of it.
import { loop } from '../../../chart/loop';
import { emptySeries, type Series } from '../../../data/series';
import { readQuery, setQuery } from '../../../router/router.svelte';
import type { Session } from '../session.svelte';
import { Evaluation, seriesOf, type Recorded } from './evaluation';
import type { Rule, RuleSettings } from './rule';
import type { Rates } from './score';

export interface Outcome {
  lane: string;
  threshold: Series;
  alarm: Series;
  rates: Rates;
  /** Of the lane's own flags over the same ticks. */
  own: Rates;
}

export type Changes = Partial<Pick<RuleSettings, 'rule' | 'tau' | 'eta' | 'iota' | 'level'>>;

export const limits = { tau: [2, 1000], eta: [0, 20], iota: [0, 1e6], level: [1e-9, 1e9] } as const;
export type NumberName = keyof typeof limits;
const rules: readonly Rule[] = ['printed', 'frozen', 'fixed'];

export function kept(name: NumberName, value: number): number {
  const [least, most] = limits[name];
  const inside = Math.min(most, Math.max(least, value));
  return name === 'tau' ? Math.round(inside) : inside;
}

export function changesText(changes: Changes): string | null {
  const parts = Object.entries(changes).map(([name, value]) => `${name}:${value}`);
  return parts.length ? parts.join() : null;
}

/** What of the text can be read: an address may have been written by hand. */
export function readChanges(text: string | null): Changes {
  const changes: Changes = {};
  for (const part of (text ?? '').split(',')) {
    const [name, value] = part.split(':');
    const rule = rules.find((one) => name === 'rule' && one === value);
    if (rule) changes.rule = rule;
    else if (name && Object.hasOwn(limits, name) && value && Number.isFinite(Number(value))) changes[name as NumberName] = kept(name as NumberName, Number(value));
  }
  return changes;
}

export class WhatIf {
  changes = $state.raw<Changes>(readChanges(readQuery('whatif')));
  outcome = $state.raw<Outcome | null>(null);
  private made: { key: string; evaluation: Evaluation } | null = null;

  get active(): boolean {
    return Object.keys(this.changes).length > 0;
  }

  change(changes: Changes): void {
    this.put({ ...this.changes, ...changes });
  }

  reset(): void {
    this.put({});
  }

  private put(changes: Changes): void {
    this.changes = changes;
    setQuery({ whatif: changesText(changes) });
    loop.invalidate();
  }

  /** Judges what is new of the record, or all of it where the settings are others. */
  judge(lane: string, record: Recorded, settings: RuleSettings, counting: { from: number; tail: number }, step: number): void {
    const key = JSON.stringify([lane, settings, counting, record.k[0]]);
    if (this.made?.key !== key || record.k.length < this.made.evaluation.k.length) this.made = { key, evaluation: new Evaluation(settings, counting.from, counting.tail) };
    const { evaluation } = this.made;
    evaluation.feed(record);
    this.outcome = { lane, threshold: seriesOf(evaluation.k, evaluation.thresholds, step), alarm: seriesOf(evaluation.k, evaluation.flags, step), rates: evaluation.rates, own: evaluation.ownRates };
    loop.invalidate();
  }
}

/** The part of a series inside [from, to], with one point more on both sides. */
export function within(series: Series, from: number, to: number): Series {
  const { k } = series;
  if (!k.length) return emptySeries;
  let begin = 0;
  let end = k.length;
  while (begin < k.length - 1 && k[begin + 1]! < from) begin++;
  while (end > begin + 1 && k[end - 2]! > to) end--;
  const lo = series.lo.subarray(begin, end);
  return { k: k.subarray(begin, end), lo, hi: lo, joined: series.joined.subarray(begin, end) };
}

const known = new WeakMap<Session, WhatIf>();

export function whatIfOf(session: Session): WhatIf {
  let found = known.get(session);
  if (!found) known.set(session, (found = new WhatIf()));
  return found;
}
