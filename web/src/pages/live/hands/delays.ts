/// How long every lane takes to notice an attack: from the marks of attacks and alarms, never from frames, which may be thinned.
import type { Mark } from '../../../api/types';
import type { RunModel } from '../model';
import type { AttackSpan } from './spans';

export type Notice =
  /** It has no detector. */
  | { kind: 'none' }
  /** No attack reaches it. */
  | { kind: 'spared' }
  /** An alarm was on already when the attack began. */
  | { kind: 'already'; since: number }
  | { kind: 'noticed'; k: number; ticks: number }
  /** The attack goes on: ticks so far. */
  | { kind: 'waiting'; ticks: number }
  | { kind: 'missed' }
  /** The alarms of that time are not held here any more. */
  | { kind: 'unknown' };

export interface LaneNotice {
  lane: string;
  notice: Notice;
}

type Nodes = ReadonlySet<string> | null;

/** Nodes at which an attack arrives: of sensors and actuators their own, of links the receivers; null: anywhere. */
export function reachedNodes(span: AttackSpan, model: Pick<RunModel, 'links'>): Nodes {
  const nodes = new Set<string>();
  for (const place of span.entry.on) {
    if (place === 'link:*') return null;
    const id = place.slice(place.indexOf(':') + 1);
    const link = place.startsWith('link:') ? model.links.find((one) => one.id === id) : null;
    nodes.add(link ? link.to : id.split('.')[0]!);
  }
  return nodes;
}

/** Outputs of a lane that a detector judges. */
export function judgedOutputs(model: Pick<RunModel, 'signals'>, lane: string): string[] {
  const prefix = `lane.${lane}.`;
  const names = new Set(model.signals.map(({ name }) => name).filter((name) => name.startsWith(prefix)));
  // What only says that something was reconstructed has no threshold: it is no detector, and marks no alarms.
  return [...names].filter((name) => name.endsWith('.alarm') && names.has(`${name.slice(0, -'alarm'.length)}threshold`)).map((name) => name.slice(prefix.length, -'.alarm'.length));
}

/** The first alarm at or after `from` and before `end`; `on`: since when one was on at `from` already. */
function alarms(marks: readonly Mark[], from: number, end: number): { first: number | null; on: number | null } {
  const since = new Map<string, number>();
  for (const { k, edge, node = '' } of marks) {
    // One that ends with the attack's very tick is off.
    if (k > from || (k === from && edge !== 'end')) continue;
    if (edge === 'begin') since.set(node, k);
    else since.delete(node);
  }
  if (since.size) return { first: null, on: Math.min(...since.values()) };
  return { first: marks.find(({ k, edge }) => edge === 'begin' && k >= from && k < end)?.k ?? null, on: null };
}

/** For every lane of the run. `from`: the tick from which on all alarms are held. */
export function noticesOf(span: AttackSpan, model: Pick<RunModel, 'lanes' | 'links' | 'signals'>, marks: readonly Mark[], head: number, held = 0): LaneNotice[] {
  const reached = reachedNodes(span, model);
  const ended = span.active ? Infinity : (span.acted.at(-1)?.to ?? head) + 1;
  return model.lanes.map(({ id, adversary }): LaneNotice => {
    const outputs = judgedOutputs(model, id);
    if (!outputs.length) return { lane: id, notice: { kind: 'none' } };
    if (!adversary) return { lane: id, notice: { kind: 'spared' } };
    // A lane with one output for all nodes hears the attack there.
    const near = reached ? outputs.filter((output) => reached.has(output)) : outputs;
    const outputsHere = new Set(near.length ? near : outputs);
    if (span.from < held) return { lane: id, notice: { kind: 'unknown' } };
    const own = marks.filter((mark) => mark.type === 'alarm' && mark.lane === id && outputsHere.has(mark.node ?? ''));
    const { first, on } = alarms(own, span.from, ended);
    if (first !== null) return { lane: id, notice: { kind: 'noticed', k: first, ticks: first - span.from } };
    if (on !== null) return { lane: id, notice: { kind: 'already', since: on } };
    return { lane: id, notice: span.active ? { kind: 'waiting', ticks: Math.max(0, head - span.from + 1) } : { kind: 'missed' } };
  });
}
