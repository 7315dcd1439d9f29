/// Campaigns: many runs of one scenario, and what comes out of them.
import { address, freshKey, get, patch, post, remove, textOf } from './client';
import type { NewRun, Page } from './types';

export type CampaignState = 'queued' | 'running' | 'paused' | 'interrupted' | 'finished' | 'cancelled' | 'failed';

/** States in which trials can still come. */
export const openStates: readonly CampaignState[] = ['queued', 'running', 'paused', 'interrupted'];
export const isOpen = (state: CampaignState): boolean => openStates.includes(state);

export interface CampaignProgress {
  done: number;
  trials: number;
  failed: number;
  trials_per_second: number | null;
  seconds_left: number | null;
}

/** Values by the path that is swept. */
export type Point = Record<string, unknown>;

/** Who makes the trials: the server itself, or processes that its broker reaches. */
export type Crew = 'threads' | 'workers';

export interface Worker {
  name: string;
  threads: number;
  /** Why it takes no trial of this campaign. */
  refused: string | null;
}

export interface CampaignItem {
  id: string;
  state: CampaignState;
  scenario: string;
  runs: number;
  first_seed: number;
  sweep: Record<string, unknown[]>;
  points: number;
  threads: number;
  crew: Crew;
  workers: Worker[];
  samples: boolean;
  tags: string[];
  note: string;
  progress: CampaignProgress;
  created: string;
  ended: string | null;
  error: string | null;
}

export interface MetricKey {
  lane: string;
  node: string | null;
  name: string;
  variant: string | null;
}

export interface Statistics {
  lane: string;
  mean: number | null;
  se: number | null;
  median: number | null;
  min: number | null;
  max: number | null;
  /** By "0.05", "0.25", "0.75", "0.95". */
  quantiles: Record<string, number | null>;
  n: number;
}

export interface CellSummary {
  cell: number;
  sweep: Point;
}

/** A metric whatever its lane: "name", "node.name", with ":variant"; and which lanes have it, by their place. */
export interface MetricName {
  id: string;
  node: string | null;
  lanes: number[];
}

/** A campaign without its figures. */
export interface CampaignDetail extends CampaignItem {
  document: { lanes?: unknown } & Record<string, unknown>;
  cells: CellSummary[];
  names: { lanes: string[]; metrics: MetricName[] };
  warnings: string[];
}

/** Figures of chosen metrics, point by point. */
export interface CampaignResults {
  from: number;
  /** Trials that were there. */
  done: number;
  lanes: string[];
  metrics: string[];
  figures: string[];
  /** Cell, place of the lane, place of the metric, figures. */
  rows: (number | null)[][];
}

/** Values of chosen metrics, trial by trial from the index `from` on. */
export interface TrialValues {
  from: number;
  n: number;
  /** By their place among the metrics that were asked for. */
  values: (number | null)[][];
  next: number | null;
}

/** The difference `lane - base`, trial by trial, and its 95 % interval. */
export interface PairedDifference extends MetricKey {
  base: string;
  mean: number | null;
  se: number | null;
  lo: number | null;
  hi: number | null;
  p: number | null;
  n: number;
}

export interface RocCurve {
  area: number | null;
  /** Threshold or factor (null: never), false-alarm rate, detection rate. */
  points: [number | null, number | null, number | null][];
}

export interface Detection {
  lane: string;
  node: string | null;
  attacked: number;
  clean: number;
  own: { fpr: number | null; tpr: number | null };
  by_factor: RocCurve;
  by_threshold: RocCurve;
}

export interface CellResult {
  trials: { finished: number; stopped: number; failed: number };
  paired: PairedDifference[];
  detection: Detection[];
}

export interface TrialItem {
  index: number;
  cell: number;
  seed: number;
  state: 'finished' | 'stopped' | 'failed';
  faults: { lane: string; code: string; detail: string }[];
  error: string | null;
  /** The run that keeps its samples. */
  run: string | null;
  value?: number | null;
}

export interface TrialDetail extends TrialItem {
  request: NewRun;
  command: string;
}

export interface NewCampaign {
  scenario: string | Record<string, unknown>;
  patch?: Record<string, unknown>;
  runs: number;
  first_seed?: number;
  sweep?: Record<string, unknown[]>;
  threads?: number;
  crew?: Crew;
  samples?: boolean;
  input?: { trace: string };
  tags?: string[];
  note?: string;
}

export interface TrialQuery {
  cell: number;
  /** lane.name or lane.node.name, with :variant */
  metric?: string;
  sort?: 'index' | 'value' | '-value' | 'outlier';
  state?: 'finished' | 'stopped' | 'failed';
  limit?: number;
  cursor?: string;
}

const path = (id: string, rest = ''): string => `/campaigns/${encodeURIComponent(id)}${rest}`;

export const campaigns = {
  list: (query: { limit?: number; cursor?: string } = {}, signal?: AbortSignal) => get<Page<CampaignItem>>('/campaigns', query, signal),
  one: (id: string, signal?: AbortSignal) => get<CampaignDetail>(path(id), { results: 'false' }, signal),
  results: (id: string, metric: string, from: number, signal?: AbortSignal) => get<CampaignResults>(path(id, '/results'), { metric, from }, signal),
  values: (id: string, query: { metrics: readonly string[]; cell?: number; from?: number; limit?: number }, signal?: AbortSignal) =>
    get<TrialValues>(path(id, '/values'), { metric: query.metrics.join(','), cell: query.cell, from: query.from, limit: query.limit }, signal),
  cell: async (id: string, cell: number, signal?: AbortSignal) => (await get<{ result: CellResult | null }>(path(id, `/cells/${cell}`), {}, signal)).result,
  trials: (id: string, query: TrialQuery, signal?: AbortSignal) => get<Page<TrialItem>>(path(id, '/trials'), { ...query }, signal),
  trial: (id: string, index: number, signal?: AbortSignal) => get<TrialDetail>(path(id, `/trials/${index}`), {}, signal),
  /** Starts a campaign. The same key sent again starts no second one. */
  start: (campaign: NewCampaign, key: string = freshKey()) => post<CampaignItem>('/campaigns', campaign, { 'Idempotency-Key': key }),
  set: (id: string, state: 'paused' | 'running' | 'cancelled') => patch<CampaignItem>(path(id), { state }),
  describe: (id: string, words: { tags: string[]; note: string }) => patch<CampaignItem>(path(id), words),
  remove: (id: string) => remove(path(id)),
  /** All statistics as the server's own CSV. */
  csv: (id: string) => textOf(path(id), 'text/csv'),
  address: (id: string) => address(path(id)),
};
