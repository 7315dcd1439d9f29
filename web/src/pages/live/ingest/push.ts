/// A table of rows, piece by piece, into a run that takes readings.
import type { BrokerName } from '../../../api/broker';
import { address, postCsv } from '../../../api/client';
import { ApiProblem } from '../../../api/problem';
import { cellsOf, linesOf } from '../../../data/csv_text';

/** What became of rows, as the server says it. */
export interface Tally {
  accepted: number;
  duplicate: number;
  late: number;
  beyond: number;
}

export interface IngestStatus extends Tally {
  columns: string[];
  nodes: string[];
  /** s */
  deadline: number;
  /** Ticks that have rows and wait for more. */
  open: number[];
  /** The newest tick that waits for nothing any more. */
  closed: number | null;
  /** Ticks that wait for the run. */
  waiting: number;
  room: number;
  /** Where messages of a broker are taken, too: the run's name there. */
  mqtt?: BrokerName;
  /** Messages that could not be used, and the newest reasons. */
  refused?: { messages: number; newest: string[] };
}

const rowsACall = 500;
const lettersACall = 4_000_000;
const waitSeconds = 1;

export const nothingPushed: Tally = { accepted: 0, duplicate: 0, late: 0, beyond: 0 };

/** Why a table cannot be pushed: `k` (it has none), `columns` (none that the run takes), `ragged` (a row of another length). */
export class Unfit extends Error {
  constructor(
    readonly why: 'k' | 'columns' | 'ragged',
    readonly line = 0,
  ) {
    super(why);
  }
}

const quoted = (cell: string): string => (/[",]/.test(cell) ? `"${cell}"` : cell);

/** The table in pieces that one call takes, with the columns that the run takes and nothing else. Throws Unfit. */
export function* pieces(text: string, columns: readonly string[], most = rowsACall): Generator<{ csv: string; rows: number }> {
  const taken = new Set(['k', 'seq', ...columns]);
  let names: string[] | null = null;
  let picked: number[] = [];
  let head = '';
  let body = '';
  let rows = 0;
  let line = 0;
  for (const one of linesOf(text)) {
    line++;
    const cells = cellsOf(one);
    if (!names) {
      names = cells;
      picked = [...cells.keys()].filter((i) => taken.has(cells[i]!));
      if (!cells.includes('k')) throw new Unfit('k');
      if (!picked.some((i) => columns.includes(cells[i]!))) throw new Unfit('columns');
      head = `${picked.map((i) => cells[i]).join()}\n`;
      continue;
    }
    if (cells.length !== names.length) throw new Unfit('ragged', line);
    body += `${picked.map((i) => quoted(cells[i]!)).join()}\n`;
    rows++;
    if (rows < most && body.length < lettersACall) continue;
    yield { csv: head + body, rows };
    [body, rows] = ['', 0];
  }
  if (!names) throw new Unfit('k');
  if (rows) yield { csv: head + body, rows };
}

export interface Progress {
  /** Rows sent. */
  sent: number;
  total: Tally;
  /** The run is behind: the same is sent again soon. */
  behind: boolean;
}

interface Push {
  run: string;
  text: string;
  columns: readonly string[];
  told: (progress: Progress) => void;
  signal: AbortSignal;
  post?: (path: string, csv: string) => Promise<Tally>;
  wait?: (seconds: number) => Promise<void>;
}

export const ingestPath = (run: string): string => `/ingest/${encodeURIComponent(run)}`;
/** Where rows are pushed to, whole. */
export const ingestAddress = (run: string): string => location.origin + address(ingestPath(run));

/** Sends everything, as often as the run asks for patience. Throws ApiProblem, Unfit. */
export async function push({ run, text, columns, told, signal, post = postCsv, wait = pause }: Push): Promise<Progress> {
  const progress: Progress = { sent: 0, total: { ...nothingPushed }, behind: false };
  for (const { csv, rows } of pieces(text, columns)) {
    for (;;) {
      if (signal.aborted) return progress;
      try {
        const became = await post(ingestPath(run), csv);
        for (const key of ['accepted', 'duplicate', 'late', 'beyond'] as const) progress.total[key] += became[key];
        progress.behind = false;
        break;
      } catch (error) {
        if (!(error instanceof ApiProblem) || error.status !== 429) throw error;
        progress.behind = true;
        told({ ...progress });
        await wait(error.retryAfter ?? waitSeconds);
      }
    }
    progress.sent += rows;
    told({ ...progress });
  }
  return progress;
}

const pause = (seconds: number): Promise<void> => new Promise((done) => setTimeout(done, seconds * 1000));
