/// Which signal a column probably is: by its name, equal or near. A person has the last word.
import { nothing, time, type Role } from './mapping';

const times = ['t', 'time', 'times', 'seconds', 'timestamp'];
/** Names that say nothing of a signal. */
const none = ['k', 'step', 'tick', 'row', 'index', 'id'];
/** Edits in a hundred letters up to which two names are near, and letters that a name needs for that. */
const nearShare = 0.25;
const leastLetters = 5;

const plain = (name: string): string => name.toLowerCase().replace(/[^\p{L}\p{N}]+/gu, '');

/** What people call a signal, best first. */
export function aliases(signal: string): string[] {
  const parts = signal.split('.');
  const [kind, node] = parts;
  const last = parts.at(-1)!;
  const names = [signal];
  if (kind === 'sensor') names.push(`${last}${node}`, `${node}${last}`, `node${node}${last}`, `${last}node${node}`, `s${node}${last}`);
  if (kind === 'truth') names.push(`true${last}`, `${last}true`, `${last}truth`, `groundtruth${last}`, last);
  if (kind === 'input') names.push(`in${last}`, `control${last}`, last);
  if (kind === 'lane') names.push(`${last}hat${parts[2]}`, `est${last}${parts[2]}`, `${last}est${parts[2]}`, `estimate${parts[2]}${last}`, `${parts[1]}${parts[2]}${last}`);
  return names.map(plain);
}

/** Letters to insert, leave out or exchange until one word is the other. */
export function edits(a: string, b: string): number {
  let before = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const row = [i];
    for (let j = 1; j <= b.length; j++) row.push(Math.min(row[j - 1]! + 1, before[j]! + 1, before[j - 1]! + (a[i - 1] === b[j - 1] ? 0 : 1)));
    before = row;
  }
  return before[b.length]!;
}

/** 0: as equal as can be; Infinity: another name. */
function distance(column: string, signal: readonly string[]): number {
  const place = signal.indexOf(column);
  if (place >= 0) return place / 100;
  if (column.length < leastLetters) return Infinity;
  // A digit is a node or a channel: another digit is another thing, however near the words are.
  const digits = (name: string): string => name.replace(/\D+/g, '');
  const near = signal.filter((name) => digits(name) === digits(column)).map((name) => edits(column, name) / Math.max(column.length, name.length));
  const least = Math.min(Infinity, ...near);
  return least <= nearShare ? 1 + least : Infinity;
}

/** A role for every column; each signal at most once, the nearest pair first. */
export function guess(names: readonly string[], signals: readonly string[]): Map<string, Role> {
  const roles = new Map(names.map((name): [string, Role] => [name, nothing]));
  const known = signals.map((signal) => ({ signal, names: aliases(signal) }));
  const pairs = names.flatMap((name) => {
    const word = plain(name);
    if (none.includes(word) || times.includes(word)) return [];
    return known.map(({ signal, names: own }) => ({ name, signal, far: distance(word, own) })).filter(({ far }) => far < Infinity);
  });
  const used = new Set<string>();
  for (const { name, signal } of pairs.sort((a, b) => a.far - b.far)) {
    if (used.has(signal) || roles.get(name) !== nothing) continue;
    used.add(signal);
    roles.set(name, signal);
  }
  const clock = names.find((name) => times.includes(plain(name)));
  if (clock !== undefined) roles.set(clock, time);
  return roles;
}

/** Seconds between rows, from the first two cells of a time column; null: they do not say. */
export function stepOf(cells: readonly (string | undefined)[]): number | null {
  const [a, b] = cells.map((cell) => (cell === undefined || cell === '' ? NaN : Number(cell)));
  const step = Number((b! - a!).toPrecision(12));
  return Number.isFinite(step) && step > 0 ? step : null;
}
