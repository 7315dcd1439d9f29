/// What a run's readings come from, as the form has it and as the server takes it.
import type { NewRun } from '../../api/types';

export type InputKind = 'simulate' | 'ingest' | 'trace';

export interface ChosenInput {
  kind: InputKind;
  trace: string;
  /** s, as typed */
  deadline: string;
  /** Names of further columns, as typed. */
  further: string;
  /** Which field is wrong. */
  fault: '' | 'deadline';
  body: NonNullable<NewRun['input']>;
}

export const usualDeadline = '1';

function bodyOf({ kind, trace, further }: Pick<ChosenInput, 'kind' | 'trace' | 'further'>, seconds: number): ChosenInput['body'] {
  if (kind === 'trace') return { trace };
  if (kind === 'simulate') return 'simulate';
  const columns = further.split(/[\s,]+/).filter(Boolean);
  return { ingest: { deadline: seconds, ...(columns.length ? { columns } : {}) } };
}

export function chosen(fields: Pick<ChosenInput, 'kind' | 'trace' | 'deadline' | 'further'>): ChosenInput {
  const seconds = /^\d*\.?\d+(e-?\d+)?$/i.test(fields.deadline.trim()) ? Number(fields.deadline) : NaN;
  const fault = fields.kind === 'ingest' && !(seconds >= 0.001 && seconds <= 3600) ? 'deadline' : '';
  return { ...fields, fault, body: bodyOf(fields, seconds) };
}

/** What the address asks for: a stored trace, or nothing special. */
export function readInput(trace: string | null): ChosenInput {
  const known = trace !== null && /^\d{1,18}$/.test(trace);
  return chosen({ kind: known ? 'trace' : 'simulate', trace: known ? trace : '', deadline: usualDeadline, further: '' });
}
