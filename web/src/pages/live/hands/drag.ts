/// What becomes of an attack's time when its bar is dragged, and what then can honestly be done.
import type { NewAttack, RunDetail } from '../../../api/types';
import { setByHand } from '../attack_places';
import type { AttackSpan } from './spans';

export interface Times {
  from: number;
  /** Last tick; null: until it is stopped. */
  to: number | null;
}

/** What of the bar is taken: its body or one of its ends. */
export type Grip = 'body' | 'from' | 'to';

/** `by` ticks further. It stays within ticks 1 to `last` and at least one tick long; `shown`: where a bar without an end seems to end. */
export function dragged(start: Times, grip: Grip, by: number, last: number, shown: number): Times {
  const step = Math.round(by);
  const clamp = (k: number, least: number, most: number): number => Math.max(least, Math.min(most, k));
  if (grip === 'from') return { from: clamp(start.from + step, 1, start.to ?? shown), to: start.to };
  if (grip === 'to') return { from: start.from, to: clamp((start.to ?? shown) + step, start.from, last) };
  const length = start.to === null ? 0 : start.to - start.from;
  const from = clamp(start.from + step, 1, Math.max(1, last - length));
  return { from, to: start.to === null ? null : from + length };
}

/** The grip under a pointer: ends take `reach` px at most, a third of a short bar. */
export function gripAt(x: number, left: number, right: number, reach = 7): Grip {
  const room = Math.min(reach, (right - left) / 3);
  if (x <= left + room) return 'from';
  return x >= right - room ? 'to' : 'body';
}

export type Proposal =
  /** The past is not changed: another run has the attack then. `lost`: what was changed by hand after k and is not repeated. */
  | { kind: 'fork'; k: number; patch: { adversary: Record<string, unknown> }; record: boolean; lost: number }
  /** It has not begun: it is ended here and started anew. */
  | { kind: 'anew'; stop: string; attack: NewAttack };

/** Parameters of an attack whose times come from outside. A record that would not be over by then is left out: the ticks before are played. */
function timeless(span: AttackSpan, from: number): { params: Record<string, unknown>; record: boolean } {
  const params = Object.fromEntries(Object.entries(span.entry.params ?? {}).filter(([name, value]) => setByHand(span.entry.type, name) && value !== null));
  const record = span.entry.type === 'replay' && !(typeof params.record_to === 'number' && params.record_to < from);
  if (record) {
    delete params.record_from;
    delete params.record_to;
  }
  return { params, record };
}

function byHand(span: AttackSpan, { from, to }: Times): { attack: NewAttack; record: boolean } {
  const { params, record } = timeless(span, from);
  const schedule = span.entry.schedule;
  return { attack: { type: span.entry.type, on: span.entry.on, from, to, params, ...(schedule ? { schedule } : {}) }, record };
}

/** An id for the attack in its new time: one of the document keeps its own for what is switched off. */
function freshId(id: string, taken: ReadonlySet<string>): string {
  const stem = `${id.slice(0, 24)}_moved`;
  if (!taken.has(stem)) return stem;
  for (let n = 2; ; n += 1) if (!taken.has(`${stem}${n}`)) return `${stem}${n}`;
}

/** The times that a document declares are the ones it acts at: then they are what is changed. */
function declares(span: AttackSpan): boolean {
  return span.command === null && (span.entry.enabled ?? true) && (span.entry.from ?? 1) === span.from;
}

export function proposalFor(run: Pick<RunDetail, 'commands'>, spans: readonly AttackSpan[], span: AttackSpan, next: Times, head: number, live: boolean): Proposal {
  if (live && !span.begun && next.from > head + 1) return { kind: 'anew', stop: span.id, attack: byHand(span, next).attack };
  // Before its command, where a hand started it: else the fork would inherit it.
  const k = Math.max(0, Math.min(span.from, next.from, span.command ?? Infinity, head + 1) - 1);
  const adversary: Record<string, unknown> = {};
  let record = false;
  if (declares(span)) adversary[span.id] = { from: next.from, to: next.to };
  else {
    const made = byHand(span, next);
    record = made.record;
    if (span.command === null) adversary[span.id] = null;
    adversary[span.command === null ? freshId(span.id, new Set(spans.map(({ id }) => id))) : span.id] = made.attack;
  }
  // What else was started by hand after the fork is kept as it was.
  const others = spans.filter((one) => one !== span && one.command !== null && one.command > k);
  for (const one of others) adversary[one.id] = byHand(one, { from: Math.max(one.from, k + 1), to: one.to }).attack;
  const lost = (run.commands ?? []).filter((command) => command.k > k && 'params' in command.body).length;
  return { kind: 'fork', k, patch: { adversary }, record, lost };
}
