/// What the comparison shows and does not show, in words: from the run's own document, design and figures (specification, 8.1 to 8.3).
import type { RunDetail } from '../../../api/types';
import { formatNumber } from '../../../i18n/format.svelte';
import { laneWord } from '../model';
import { nodeMetric, sizeOf } from './figures';
import { kindOf, presetOf } from './kinds';
import { recordOf } from './record';
import type { SubsystemModel } from './subsystems';
import type { en } from './words';

export interface Sentence {
  id: string;
  key: keyof typeof en;
  values?: Record<string, string | number>;
  tone?: 'good' | 'bad';
}

export interface Facts {
  run: Pick<RunDetail, 'document' | 'design' | 'metrics'>;
  lanes: readonly string[];
  subsystems: readonly SubsystemModel[];
  /** Root mean square of each true attack and fault over the window of the figures. */
  sizes: ReadonlyMap<string, number>;
}

interface Miss {
  id: string;
  error: number;
  size: number;
}

/** An estimate counts as following its attack below this share of the attack's size, as missing it above the other. */
export const follows = 0.3;
export const misses = 0.6;

/** A lane's attack error against the attack itself, in every subsystem that was attacked. */
function attacked({ run, subsystems, sizes }: Facts, lane: string): Miss[] {
  return subsystems.flatMap((subsystem): Miss[] => {
    const size = sizeOf(subsystem, 'attack', sizes);
    const error = nodeMetric(run.metrics, lane, subsystem.id, 'rms_attack_error');
    return size && error !== null ? [{ id: subsystem.id, error, size }] : [];
  });
}

const all = (list: readonly Miss[], least: number, most: number): boolean => list.length > 0 && list.every(({ error, size }) => error >= least * size && error <= most * size);

export function numbersText(list: readonly Miss[], of: (values: Record<string, string>) => string): string {
  return list.map(({ id, error, size }) => of({ id, error: formatNumber(error), size: formatNumber(size) })).join('; ');
}

type Say = (values: Record<string, string>) => string;

export function sentencesOf(facts: Facts, say: Say): Sentence[] {
  const of = (kind: string): string[] => facts.lanes.filter((lane) => kindOf(facts.run, lane) === kind);
  return [
    ...of('matched').flatMap((lane) => aboutMatched(facts, lane, say)),
    ...of('printed').flatMap((lane) => aboutPrinted(facts, lane, say)),
    ...of('proposed').flatMap((lane) => aboutProposed(facts, lane, say)),
    ...aboutClassical(facts),
  ];
}

/** Figure 7: the matched observer exists where rank(CD) = rank(D); elsewhere it finds no attack. That only shows where one is. */
function aboutMatched(facts: Facts, lane: string, say: Say): Sentence[] {
  const flags = recordOf(facts.run, lane)?.matched ?? [];
  if (!flags.length) return [];
  const word = laneWord(lane);
  const broken = facts.subsystems.filter((_, i) => flags[i] === false).map(({ id }) => id);
  const sound = facts.subsystems.filter((_, i) => flags[i] === true).map(({ id }) => id);
  const found = attacked(facts, lane);
  const numbers = numbersText(found, say);
  const sentences: Sentence[] = [
    broken.length
      ? { id: `${lane} condition`, key: 'matching_fails', values: { lane: word, yes: sound.join(', ') || '–', no: broken.join(', ') }, tone: 'bad' }
      : { id: `${lane} condition`, key: 'matching_holds', values: { lane: word }, tone: 'good' },
  ];
  if (!found.length) return sentences;
  const hit = found.filter(({ id }) => broken.includes(id));
  if (broken.length && !hit.length) sentences.push({ id: `${lane} figure 7`, key: all(found, 0, follows) ? 'figure7_not_shown' : 'figure7_unattacked', values: { lane: word, numbers } });
  else if (hit.length) {
    const key = all(hit, misses, Infinity) ? 'figure7_shown' : 'figure7_attacked';
    sentences.push({ id: `${lane} figure 7`, key, values: { lane: word, no: hit.map(({ id }) => id).join(', '), numbers }, tone: key === 'figure7_shown' ? 'bad' : undefined });
  } else sentences.push({ id: `${lane} figure 7`, key: all(found, 0, follows) ? 'figure5_shown' : 'matched_numbers', values: { lane: word, numbers } });
  return sentences;
}

/** Stable and certified, and yet they do not estimate the attacks: both from the run's own record and figures. */
function aboutPrinted(facts: Facts, lane: string, say: Say): Sentence[] {
  const record = recordOf(facts.run, lane);
  if (!record) return [];
  const stable = record.maxRealPole !== null && record.maxRealPole < 0;
  const list = (values: readonly number[]): string => values.map((value) => formatNumber(value)).join(', ');
  const values = { lane: laneWord(lane), pole: formatNumber(record.maxRealPole), gamma_d: list(record.gammaD), gamma_w: list(record.gammaW), reason: record.reason };
  const sentences: Sentence[] = [{ id: `${lane} certificate`, key: !stable ? 'printed_unstable' : record.holds ? 'printed_certified' : 'printed_uncertified', values, tone: stable && record.holds ? 'good' : 'bad' }];
  const found = attacked(facts, lane);
  if (!found.length) return sentences;
  const missing = all(found, misses, Infinity);
  sentences.push({ id: `${lane} numbers`, key: missing ? 'printed_misses' : 'printed_numbers', values: { lane: values.lane, numbers: numbersText(found, say) }, tone: missing ? 'bad' : undefined });
  if (missing && record.holds) sentences.push({ id: `${lane} why`, key: 'printed_why' });
  return sentences;
}

function aboutProposed(facts: Facts, lane: string, say: Say): Sentence[] {
  const found = attacked(facts, lane);
  if (!found.length) return [];
  const word = laneWord(lane);
  if (all(found, 0, follows)) return [{ id: `${lane} follows`, key: 'proposed_follows', values: { lane: word, numbers: numbersText(found, say) }, tone: 'good' }];
  const record = recordOf(facts.run, lane);
  return found
    .filter(({ error, size }) => error >= misses * size)
    .map((miss): Sentence => {
      const gamma = record?.gammaD[facts.subsystems.findIndex(({ id }) => id === miss.id)];
      const leaks = gamma !== undefined && gamma > 1;
      return { id: `${lane} misses ${miss.id}`, key: leaks ? 'proposed_leaks' : 'proposed_misses', values: { lane: word, numbers: numbersText([miss], say), gamma: formatNumber(gamma) }, tone: 'bad' };
    });
}

/** Figure 8: with and without the innovation in the attack's own equation, under the same bounds. */
function aboutClassical(facts: Facts): Sentence[] {
  const classical = facts.lanes.filter((lane) => kindOf(facts.run, lane) === 'classical');
  const sentences = classical.flatMap((lane): Sentence[] => {
    const other = facts.lanes.find((one) => kindOf(facts.run, one) === 'proposed' && presetOf(facts.run, one) === presetOf(facts.run, lane));
    if (!other) return [];
    const old = attacked(facts, lane);
    const now = attacked(facts, other);
    return now.flatMap((mine): Sentence[] => {
      const theirs = old.find(({ id }) => id === mine.id);
      if (!theirs?.error) return [];
      const share = Math.round(100 * Math.abs(1 - mine.error / theirs.error));
      const lower = mine.error < theirs.error;
      const values = { lane: laneWord(other), other: laneWord(lane), id: mine.id, error: formatNumber(mine.error), reference: formatNumber(theirs.error), share };
      return [{ id: `${lane} ${mine.id}`, key: lower ? 'classical_worse' : 'classical_better', values, tone: lower ? 'good' : 'bad' }];
    });
  });
  return sentences.length ? [...sentences, { id: 'classical why', key: 'classical_why' }] : [];
}
