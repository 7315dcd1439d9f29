/// What the indices say, in words: from the run's own design and values, beside what the paper claims (specification, 4.4 and 4.7).
import { formatNumber } from '../../../i18n/format.svelte';
import { laneWord } from '../model';
import { rankOf, rankWords, type LaneReading, type PaperIndex } from './confidentiality';
import type { PrivacyDesign } from './design';
import type { en } from './words_en';

export interface Sentence {
  id: string;
  key: keyof typeof en;
  values: Record<string, string>;
  /** Values that are words of the dictionary themselves. */
  words?: Record<string, keyof typeof en>;
  tone?: 'good' | 'bad';
}

export interface LaneFacts {
  reading: LaneReading;
  design: PrivacyDesign | null;
  paper: PaperIndex | null;
  /** The printed index was what a setting of this run was fitted to. */
  fitted?: boolean;
}

export function sentencesOf(lanes: readonly LaneFacts[]): Sentence[] {
  return lanes.flatMap((facts) => [...growth(facts), ...windowMean(facts), ...printed(facts), ...negative(facts)]);
}

/** The analytic slope beside the index: what grows, and how fast. */
function growth({ reading: { lane, main }, design }: LaneFacts): Sentence[] {
  if (!design || design.slope === null) return [];
  const values = { lane: laneWord(lane.id), slope: formatNumber(design.slope), leak: formatNumber(design.leak), ci: formatNumber(main?.value) };
  return [{ id: `${lane.id} slope`, key: design.slope > 0 ? 'grows' : 'grows_not', values, tone: design.slope > 0 ? undefined : 'bad' }];
}

/** Theorem 4.2 beside an eavesdropper that it does not speak of. */
function windowMean({ reading, paper }: LaneFacts): Sentence[] {
  const found = reading.others.find(({ variant }) => variant === 'window_mean');
  if (!found) return [];
  const { value } = found.reading;
  const rank = rankOf(value);
  const key = paper === 'infinite' ? 'window_mean_paper' : 'window_mean';
  return [{ id: `${reading.lane.id} window mean`, key, values: { lane: laneWord(reading.lane.id), ci: formatNumber(value) }, words: { rank: rankWords[rank]! }, tone: rank === 0 ? 'bad' : undefined }];
}

function printed({ reading: { lane, main }, paper, fitted }: LaneFacts): Sentence[] {
  if (typeof paper !== 'number' || !main) return [];
  return [{ id: `${lane.id} printed`, key: fitted ? 'printed_fitted' : 'printed_index', values: { lane: laneWord(lane.id), paper: String(paper), ci: formatNumber(main.value) } }];
}

function negative({ reading: { lane, main } }: LaneFacts): Sentence[] {
  return main && main.value < 0 ? [{ id: `${lane.id} negative`, key: 'negative', values: { lane: laneWord(lane.id), ci: formatNumber(main.value) }, tone: 'bad' }] : [];
}
