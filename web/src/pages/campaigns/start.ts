/// What the form of a new campaign says, as the server takes it.
import type { NewCampaign } from '../../api/campaigns';
import type { Json, JsonObject } from '../../form/json';
import { at } from '../../form/pointer';
import { t } from './words';

export interface SweepRow {
  path: string;
  values: string;
}

export interface Wish {
  scenario: string;
  patch: JsonObject;
  runs: string;
  firstSeed: string;
  sweep: SweepRow[];
  samples: boolean;
  note: string;
  trace: string;
  /** Made by the broker's workers. */
  workers: boolean;
}

export const mostTrials = 10_000_000;
const kLastSeed = Number.MAX_SAFE_INTEGER - mostTrials;

export function wholeNumber(text: string, least: number, most: number): number | undefined {
  const value = /^\d+$/.test(text.trim()) ? Number(text) : NaN;
  return value >= least && value <= most ? value : undefined;
}

/** Commas and ends of lines part values, save inside brackets, braces and quotes. */
function parts(text: string): string[] {
  const result = [''];
  let depth = 0;
  let quoted = false;
  for (const c of text) {
    if (c === '"') quoted = !quoted;
    if (!quoted && (c === '[' || c === '{')) depth++;
    if (!quoted && (c === ']' || c === '}')) depth--;
    if (!quoted && depth === 0 && (c === ',' || c === '\n')) result.push('');
    else result[result.length - 1] += c;
  }
  return result.map((part) => part.trim()).filter((part) => part !== '');
}

/** Each value as JSON, or as a word where it is none. */
export function readValues(text: string): Json[] {
  return parts(text).map((part) => {
    try {
      return JSON.parse(part) as Json;
    } catch {
      return part;
    }
  });
}

const used = (rows: readonly SweepRow[]): SweepRow[] => rows.filter(({ path, values }) => path.trim() !== '' || values.trim() !== '');

/** What is wrong with the sweep, one sentence a row; empty where nothing is. `document`: null where it is not known yet. */
export function sweepFaults(rows: readonly SweepRow[], document: JsonObject | null): string[] {
  return rows.map(({ path: typed, values }, i) => {
    const path = typed.trim();
    if (path === '') return values.trim() === '' ? '' : t('sweep_no_path');
    if (rows.findIndex((other) => other.path.trim() === path) < i) return t('sweep_twice', { path });
    if (document && at(document, path.split('.')) === undefined) return t('sweep_no_member', { path });
    return readValues(values).length === 0 ? t('sweep_no_values', { path }) : '';
  });
}

export function pointsOf(rows: readonly SweepRow[]): number {
  return used(rows).reduce((product, { values }) => product * readValues(values).length, 1);
}

/** undefined where a number is wrong. */
export function bodyOf(wish: Wish): NewCampaign | undefined {
  const runs = wholeNumber(wish.runs, 1, mostTrials);
  const seed = wholeNumber(wish.firstSeed, 0, kLastSeed);
  if (runs === undefined || seed === undefined) return undefined;
  const rows = used(wish.sweep);
  return {
    scenario: wish.scenario,
    ...(Object.keys(wish.patch).length > 0 ? { patch: wish.patch } : {}),
    runs,
    first_seed: seed,
    ...(rows.length > 0 ? { sweep: Object.fromEntries(rows.map(({ path, values }) => [path.trim(), readValues(values)])) } : {}),
    // Samples are kept by the server's own threads only.
    ...(wish.samples ? { samples: true } : wish.workers ? { crew: 'workers' as const } : {}),
    ...(wish.trace ? { input: { trace: wish.trace } } : {}),
    ...(wish.note ? { note: wish.note } : {}),
  };
}

export const seedRight = (text: string): boolean => wholeNumber(text, 0, kLastSeed) !== undefined;
export const runsRight = (text: string): boolean => wholeNumber(text, 1, mostTrials) !== undefined;

/** Paths of the document that hold a number, a word or a truth value: what a sweep usually is over. */
export function leafPaths(value: Json | undefined, most = 600): string[] {
  const result: string[] = [];
  const walk = (here: Json, path: string[]): void => {
    if (result.length >= most) return;
    if (Array.isArray(here)) return;
    if (typeof here === 'object' && here !== null) for (const [key, inner] of Object.entries(here)) walk(inner, [...path, key]);
    else if (path.length > 1 && typeof here !== 'string') result.push(path.join('.'));
  };
  if (value !== undefined) walk(value, []);
  return result.filter((path) => !path.startsWith('title.') && !path.startsWith('view.'));
}

/** The address of the form, filled in: how other pages lead here. */
export function formAddress(scenario: string, patchText: string, trace = '', seed = ''): string {
  const query = new URLSearchParams({ scenario });
  if (patchText) query.set('patch', patchText);
  if (trace) query.set('trace', trace);
  if (seed && seed !== '1') query.set('seed', seed);
  return `/campaigns?${query.toString()}`;
}
