/// What the server's API answers, as its contract says. Nothing here is computed by the page.
import type { BrokerName } from './broker';
import type { DesignItem } from './designs';

export interface Localised {
  en: string;
  zh: string;
}

export type RunState = 'queued' | 'designing' | 'running' | 'paused' | 'finished' | 'stopped' | 'failed' | 'interrupted';

/** States in which a run can still make frames. */
export const liveStates: readonly RunState[] = ['queued', 'designing', 'running', 'paused'];
export function isLive(state: RunState): boolean {
  return liveStates.includes(state);
}

export interface Progress {
  k: number;
  /** null: until stopped */
  steps: number | null;
  t: number;
  dt: number;
  ticks_per_second: number | null;
}

export interface Metric {
  lane: string;
  /** null: over the whole network */
  node: string | null;
  name: string;
  variant: string | null;
  value: number | boolean | null;
}

export interface FaultCount {
  lane: string;
  node: string | number | null;
  code: string;
  first: number;
  last: number;
  count: number;
  stopped?: boolean;
  detail: string;
}

/** "max" or ticks per second */
export type Pace = 'max' | number;

export interface RunItem {
  id: string;
  scenario: string;
  /** Equal for runs of the same document, whatever their seed. */
  document_hash?: string;
  family: string;
  title: Localised;
  state: RunState;
  seed: number;
  version: string;
  pace: Pace;
  input: unknown;
  tags: string[];
  note: string;
  created: string;
  started: string | null;
  ended: string | null;
  progress: Progress;
  epoch: string;
  parent: { run: string; k: number } | null;
  viewers: number;
  /** Running, but waiting for somebody who watches. */
  idle?: boolean;
  metrics: Metric[];
  faults: FaultCount[];
  warnings: string[];
  view: ViewHints;
  error: string | null;
  reproducible: boolean;
  log: { gaps: number };
  /** Commands that it took while it ran. */
  changes?: number;
}

export interface RunDetail extends RunItem {
  /** Gains that it still waits for. */
  designing?: DesignItem[];
  design: Record<string, Record<string, unknown>>;
  commands: { k: number; body: Record<string, unknown> }[];
  document: Record<string, unknown>;
  world: World;
}

export interface World {
  nodes: { id: string; position: number[] | null }[];
  links: { id: string; from: string; to: string }[];
  lanes: { id: string; method: string; adversary: boolean }[];
  state: { name: string; unit: string }[];
}

/** Hints of a scenario to the page. */
export interface ViewHints {
  plane?: { components: [string, string]; heading?: string; unit?: string };
  space?: { components: [string, string, string]; unit?: string };
  /** Components whose signed error is drawn node by node. */
  errors?: string[];
  lane?: string;
  error_unit?: string;
  /** What the run is about are detectors. */
  detector?: boolean;
}

export type SignalKind = 'scalar' | 'bool' | 'category';

export interface Signal {
  id: number;
  name: string;
  unit: string;
  kind: SignalKind;
  lane?: string | null;
  node?: string | null;
  link?: string | null;
  labels?: Record<string, string>;
  /** Whether the log keeps it. */
  logged?: boolean;
}

export type MarkType = 'attack' | 'alarm' | 'fault' | 'command' | 'state' | 'note';

export interface Mark {
  k: number;
  type: MarkType;
  edge: 'begin' | 'end' | null;
  id?: string;
  lane?: string;
  node?: string;
  link?: string;
  code?: string;
  detail?: string;
}

export type SampleSeries =
  | { signal: string; v: (number | null)[] }
  | { signal: string; lo: (number | null)[]; hi: (number | null)[] };

export interface Samples {
  k: number[];
  series: SampleSeries[];
  /** s, of each k */
  t?: (number | null)[];
  /** Ticks that the log does not have. */
  gaps?: { from: number; to: number }[];
}

export interface Page<T> {
  items: T[];
  next: string | null;
}

export interface ScenarioItem {
  id: string;
  title: Localised;
  family: string;
  source?: string;
  preset?: boolean;
  lanes?: string[];
  summary?: Localised;
}

export interface ServerInfo {
  version: string;
  uptime: number;
  runs: { running: number; queued: number; max: number };
  viewers: number;
  log: { bytes: number; queue: number; state: string };
  demo: string | null;
  auth: boolean;
  /** The broker that campaigns find workers by; null where the server has none. */
  nats?: { connected: boolean } | null;
}

/** Whether a run's readings are pushed in. */
export function isIngest(input: unknown): boolean {
  return input === 'ingest' || (typeof input === 'object' && input !== null && 'ingest' in input);
}

export interface NewRun {
  scenario: string | Record<string, unknown>;
  patch?: Record<string, unknown>;
  seed?: number;
  pace?: Pace;
  input?: 'simulate' | 'ingest' | { trace: string } | { ingest: { deadline?: number; columns?: string[]; mqtt?: BrokerName } };
  tags?: string[];
  note?: string;
}

export interface NewAttack {
  type: string;
  on: string[];
  from?: number;
  to?: number | null;
  schedule?: Record<string, unknown>;
  params: Record<string, unknown>;
}
