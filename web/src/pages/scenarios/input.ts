/// What a run's readings come from, as the form has it and as the server takes it.
import type { Clock } from '../../api/broker';
import type { NewRun } from '../../api/types';

export type InputKind = 'simulate' | 'ingest' | 'trace';

export interface ChosenInput {
  kind: InputKind;
  trace: string;
  /** s, as typed */
  deadline: string;
  /** Names of further columns, as typed. */
  further: string;
  /** Of the run in the broker's topics, beside its id; empty: none. */
  name: string;
  clock: Clock;
  /** Which field is wrong. */
  fault: '' | 'deadline' | 'name';
  body: NonNullable<NewRun['input']>;
}

export const usualDeadline = '1';

type Fields = Omit<ChosenInput, 'fault' | 'body'>;

function bodyOf({ kind, trace, further, name, clock }: Fields, seconds: number): ChosenInput['body'] {
  if (kind === 'trace') return { trace };
  if (kind === 'simulate') return 'simulate';
  const columns = further.split(/[\s,]+/).filter(Boolean);
  return { ingest: { deadline: seconds, ...(columns.length ? { columns } : {}), ...(name.trim() ? { mqtt: { name: name.trim(), clock } } : {}) } };
}

/** Whether a text is one level of a topic. */
const isLevel = (text: string): boolean => !/[\s/+#]/.test(text) && text.length <= 200;

export function chosen(fields: Fields): ChosenInput {
  const seconds = /^\d*\.?\d+(e-?\d+)?$/i.test(fields.deadline.trim()) ? Number(fields.deadline) : NaN;
  const late = !(seconds >= 0.001 && seconds <= 3600);
  const fault = fields.kind !== 'ingest' ? '' : late ? 'deadline' : isLevel(fields.name.trim()) ? '' : 'name';
  return { ...fields, fault, body: bodyOf(fields, seconds) };
}

/** What the address asks for: a stored trace, or nothing special. */
export function readInput(trace: string | null): ChosenInput {
  const known = trace !== null && /^\d{1,18}$/.test(trace);
  return chosen({ kind: known ? 'trace' : 'simulate', trace: known ? trace : '', deadline: usualDeadline, further: '', name: '', clock: 'k' });
}
