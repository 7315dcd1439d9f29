/// The papers, run again: every figure and table with its newest result, and the job that runs them.
import { address, get, post, remove } from './client';

export type Verdict = 'reproduced' | 'reproduced after correction' | 'not reproduced';

export interface Words {
  en: string;
  zh: string;
}

/** A run that an item's figure is of: what POST /runs takes. */
export interface Scene {
  name: Words;
  scenario: string;
  patch: Record<string, unknown>;
}

export interface EquationItem {
  id: string;
  /** As the source numbers it; empty where it does not. */
  number: string;
  /** What is drawn is not what the source prints. */
  corrected: boolean;
  says: Words;
  tex: string;
  /** A `<math>` of the server's own making. */
  mathml: string;
}

export interface PaperItem {
  /** Source and figure: 000/fig4. */
  key: string;
  title: Words;
  spec: string;
  scenario: string;
  rule: string;
  reason: string;
  /** As printed, or in words; this and what follows is null before the first run. */
  paper: number | string | null;
  ours: number | null;
  se: number | null;
  verdict: Verdict | null;
  runs: number | null;
  seed: number | null;
  version: string | null;
  ended: string | null;
  /** The same in Chinese. */
  zh: { paper: number | string | null; reason: string; rule: string };
  scenes: Scene[];
  methods: { id: string; title: Words }[];
}

export interface Claim {
  reading: 'as printed' | 'corrected' | 'noted';
  what: string;
  paper: number | string | null;
  ours: number | null;
  se: number | null;
  /** Null: no bound. */
  low: number | null;
  high: number | null;
  holds: boolean;
  zh: { what: string; paper: number | string | null };
}

export type SeriesStyle = 'line' | 'dashed' | 'steps' | 'stems' | 'points' | 'edge';

export interface PanelSeries {
  name: string;
  style: SeriesStyle;
  x: (number | null)[];
  y: (number | null)[];
}

export interface PanelAxis {
  label: string;
  scale: 'linear' | 'log';
}

export interface FigurePanel {
  title: string;
  x: PanelAxis;
  y: PanelAxis;
  series: PanelSeries[];
  zh: { title: string; x: string; y: string; names: string[] };
}

export interface PaperDetail extends PaperItem {
  equations: EquationItem[];
  figure: { rule: string; claims: Claim[]; panels: FigurePanel[] } | null;
}

export interface PapersJob {
  state: 'running' | 'finished' | 'cancelled';
  items: string[];
  /** Items of the job that are over. */
  done: number;
  current: string | null;
  /** Runs of all its campaigns so far. */
  runs_made: number;
  runs: number;
  seed: number;
  failed: { key: string; error: string }[];
  started: string;
  ended: string | null;
  /** When it went on after the server had ended under it. */
  taken_up: { when: string; done: number; times: number } | null;
}

export interface PapersList {
  items: PaperItem[];
  job: PapersJob | null;
}

export interface PapersOrder {
  /** All without. */
  only?: string[];
  runs: number;
  seed: number;
}

export const papers = {
  list: (signal?: AbortSignal) => get<PapersList>('/papers', {}, signal),
  one: (key: string, signal?: AbortSignal) => get<PaperDetail>(`/papers/${key.split('/').map(encodeURIComponent).join('/')}`, {}, signal),
  start: async (order: PapersOrder): Promise<PapersJob> => (await post<{ job: PapersJob }>('/papers', order)).job,
  /** Settled once no job goes on. */
  cancel: () => remove('/papers/job'),
  reportAddress: () => address('/papers/report.html'),
};
