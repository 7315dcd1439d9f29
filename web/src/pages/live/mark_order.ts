import type { Mark, MarkType } from '../../api/types';

const types: readonly MarkType[] = ['attack', 'alarm', 'fault', 'command', 'state', 'note'];
const most = 5000;

/** Whether something read from the wire is a mark that can be drawn. */
export function isMark(value: unknown): value is Mark {
  if (typeof value !== 'object' || value === null) return false;
  const mark = value as Partial<Mark>;
  return typeof mark.k === 'number' && types.includes(mark.type as MarkType) && (mark.edge === null || mark.edge === undefined || mark.edge === 'begin' || mark.edge === 'end');
}

function key(mark: Mark): string {
  return [mark.k, mark.type, mark.edge ?? '', mark.id ?? '', mark.lane ?? '', mark.node ?? '', mark.link ?? '', mark.code ?? '', mark.detail ?? ''].join('|');
}

/** Both lists as one, by tick, none twice. Of alarms and faults only the newest few thousand: attacks and commands are never lost among them. */
export function mergeMarks(a: readonly Mark[], b: readonly Mark[]): Mark[] {
  const seen = new Set<string>();
  const all: Mark[] = [];
  for (const mark of [...a, ...b]) {
    if (!isMark(mark)) continue;
    const name = key(mark);
    if (seen.has(name)) continue;
    seen.add(name);
    all.push(mark);
  }
  all.sort((x, y) => x.k - y.k);
  let spare = all.length - most;
  return spare > 0 ? all.filter((mark) => (mark.type !== 'alarm' && mark.type !== 'fault') || spare-- <= 0) : all;
}

/** The tick from which on no alarm is missing, given a list that mergeMarks made. */
export function heldFrom(marks: readonly Mark[]): number {
  const restless = marks.filter((mark) => mark.type === 'alarm' || mark.type === 'fault');
  return restless.length < most ? 0 : restless[0]!.k + 1;
}

/** Attacks that began and did not end yet, by id. */
export function activeAttacks(marks: readonly Mark[]): Mark[] {
  const active = new Map<string, Mark>();
  for (const mark of marks) {
    if (mark.type !== 'attack' || !mark.id) continue;
    if (mark.edge === 'end') active.delete(mark.id);
    else if (!active.has(mark.id)) active.set(mark.id, mark);
  }
  return [...active.values()];
}

/** The mark before (-1) or after (+1) a tick, of those a person steps through. */
export function neighbour(marks: readonly Mark[], k: number, way: -1 | 1): Mark | null {
  if (way > 0) return marks.find((mark) => mark.k > k) ?? null;
  for (let i = marks.length - 1; i >= 0; i--) if (marks[i]!.k < k) return marks[i]!;
  return null;
}

export interface MarkGroup {
  mark: Mark;
  /** Of all marks in the group. */
  nodes: string[];
  links: string[];
  count: number;
}

/** Marks of one tick that say the same of several nodes or links, as one; newest first. */
export function groupMarks(marks: readonly Mark[], most: number): MarkGroup[] {
  const groups: MarkGroup[] = [];
  const byKey = new Map<string, MarkGroup>();
  for (let i = marks.length - 1; i >= 0; i--) {
    const mark = marks[i]!;
    const name = [mark.k, mark.type, mark.edge ?? '', mark.id ?? '', mark.lane ?? '', mark.code ?? '', mark.node ? 'node' : mark.link ? 'link' : (mark.detail ?? '')].join('|');
    let group = byKey.get(name);
    if (!group) {
      if (groups.length === most) break;
      group = { mark, nodes: [], links: [], count: 0 };
      byKey.set(name, group);
      groups.push(group);
    }
    group.count++;
    if (mark.node) group.nodes.unshift(mark.node);
    if (mark.link) group.links.unshift(mark.link);
  }
  return groups;
}
