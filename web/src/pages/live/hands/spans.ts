/// The attacks of a run as stretches of time: the document's and those started by hand, past, present and planned.
import type { Mark, RunDetail } from '../../../api/types';

/** An attack as a document or a command has it. */
export interface AttackEntry {
  type: string;
  on: string[];
  from?: number | null;
  to?: number | null;
  schedule?: Record<string, unknown> | null;
  enabled?: boolean;
  params?: Record<string, unknown>;
}

export interface AttackSpan {
  id: string;
  entry: AttackEntry;
  /** The tick before which a hand started it; null: it is the document's. */
  command: number | null;
  /** First tick it acts. */
  from: number;
  /** Last tick; null: until it is stopped. */
  to: number | null;
  begun: boolean;
  /** It acts now. */
  active: boolean;
  /** Stretches in which it acted, both ends included; the last of one that goes on has no end. */
  acted: { from: number; to: number | null }[];
}

type RunPart = Pick<RunDetail, 'document' | 'commands'>;

function isEntry(value: unknown): value is AttackEntry {
  const entry = value as Partial<AttackEntry> | null;
  return typeof entry === 'object' && entry !== null && typeof entry.type === 'string' && Array.isArray(entry.on);
}

/** Document and commands together: every attack that this run ever had, in the order in which they came. */
export function entriesOf(run: RunPart): Map<string, { entry: AttackEntry; command: number | null; enabled: boolean }> {
  const found = new Map<string, { entry: AttackEntry; command: number | null; enabled: boolean }>();
  for (const [id, entry] of Object.entries((run.document?.adversary ?? {}) as Record<string, unknown>)) {
    if (isEntry(entry)) found.set(id, { entry, command: null, enabled: entry.enabled ?? true });
  }
  for (const { k, body } of run.commands ?? []) {
    const attack = body.attack as (AttackEntry & { id?: string }) | undefined;
    if (attack?.id && isEntry(attack)) found.set(attack.id, { entry: { ...attack, from: attack.from ?? k }, command: k, enabled: true });
    const ended = typeof body.end_attack === 'string' ? found.get(body.end_attack) : undefined;
    if (ended) ended.enabled = false;
    for (const [path, value] of Object.entries((body.params ?? {}) as Record<string, unknown>)) {
      const match = /^adversary\.([^.]+)\.enabled$/.exec(path);
      const one = match ? found.get(match[1]!) : undefined;
      if (one) one.enabled = value === true;
    }
  }
  return found;
}

/** When it really acted, from the marks of its begins and ends. */
function actedOf(id: string, marks: readonly Mark[]): AttackSpan['acted'] {
  const acted: AttackSpan['acted'] = [];
  for (const mark of marks) {
    if (mark.type !== 'attack' || mark.id !== id) continue;
    const last = acted.at(-1);
    if (mark.edge === 'begin' && (!last || last.to !== null)) acted.push({ from: mark.k, to: null });
    if (mark.edge === 'end' && last?.to === null) last.to = mark.k - 1;
  }
  return acted;
}

/** By their begins. An attack that waits for a time that only itself knows is not among them until it begins. */
export function spansOf(run: RunPart, marks: readonly Mark[], head: number): AttackSpan[] {
  const spans: AttackSpan[] = [];
  for (const [id, { entry, command, enabled }] of entriesOf(run)) {
    const acted = actedOf(id, marks);
    const last = acted.at(-1);
    if (last) {
      const goesOn = last.to === null;
      const planned = goesOn ? (entry.to ?? null) : last.to;
      spans.push({ id, entry, command, from: acted[0]!.from, to: planned, begun: true, active: goesOn, acted });
    } else if (enabled && (entry.from ?? 1) > head) {
      spans.push({ id, entry, command, from: entry.from ?? 1, to: entry.to ?? null, begun: false, active: false, acted });
    }
  }
  return spans.sort((a, b) => a.from - b.from);
}

/** Whether an attack on `on` touches a place such as "link:1-2" or "sensor:3". */
export function covers(on: readonly string[], place: string): boolean {
  return on.some((one) => one === place || one.startsWith(`${place}.`) || (one === 'link:*' && place.startsWith('link:')));
}

/** "link:1-2" as a person reads it. */
export function placeText(on: readonly string[], words: { every: string; kinds: Readonly<Record<string, string>> }): string {
  return on
    .map((place) => {
      const colon = place.indexOf(':');
      const [kind, id] = [place.slice(0, colon), place.slice(colon + 1)];
      if (kind === 'link') return id === '*' ? words.every : id.replace('-', '→');
      return `${words.kinds[kind] ?? kind} ${id}`;
    })
    .join(', ');
}

/** The last tick at which a bar is drawn: of one without an end the newest, of one that is planned the track's end. */
export function shownEnd(span: AttackSpan, head: number, end: number): number {
  return span.to ?? (span.begun ? Math.max(span.from, head) : Math.max(span.from, end));
}

/** The row of each bar, so that those of one time lie below one another; the third row takes all that is left. */
export function barRows(spans: readonly AttackSpan[], head: number, most = 3): Map<string, number> {
  const ends: number[] = [];
  const rows = new Map<string, number>();
  for (const span of spans) {
    const free = ends.findIndex((end) => end < span.from);
    const row = free >= 0 ? free : Math.min(ends.length, most - 1);
    ends[row] = Math.max(ends[row] ?? 0, shownEnd(span, head, Infinity));
    rows.set(span.id, row);
  }
  return rows;
}

/** How far the track must reach for the plans to be seen; not beyond the run, nor far beyond what there is. */
export function plannedEnd(spans: readonly AttackSpan[], head: number, steps: number | null): number {
  const most = steps ?? 2 * head + 200;
  const ends = spans.flatMap(({ begun, active, from, to }) => (begun ? (active && to !== null ? [to] : []) : [to ?? from + 10])).filter((k) => k <= 4 * most);
  return Math.min(most, Math.max(0, ...ends));
}
