/// Where panels get samples: the rings of the running streams first, else windows fetched from the log.
///
/// Nothing here is reactive. A panel asks at every drawing; what is lacking is fetched once and the panels are told.
import { api } from '../api/client';
import type { Samples, Signal } from '../api/types';
import type { Frame } from '../stream/events';
import type { Ring } from './ring';
import { concatSeries, emptySeries, ringSeries, samplesSeries, type Series } from './series';

/** Points asked of the server for a window: about one a pixel of a wide screen. */
export const windowPoints = 1200;
const signalsPerCall = 200;
const refreshMs = 1000;
const forgetMs = 3000;

interface Table {
  from: number;
  to: number;
  raw: boolean;
  series: Map<string, Series>;
}

type FetchSamples = (query: { signals: string; from: number; to: number; points: number }, signal: AbortSignal) => Promise<Samples>;

export class Source {
  readonly byName: Map<string, Signal>;
  rings: Ring[] = [];
  /** Newest tick known. */
  head = -1;
  /** Whether `head` still grows. */
  growing = false;
  /** Counts up with every change of what can be drawn. */
  version = 0;
  loading = false;
  failure: unknown = null;

  private table: Table | null = null;
  private wanted = new Map<string, number>();
  private asked: { from: number; to: number } | null = null;
  private timer: ReturnType<typeof setTimeout> | null = null;
  private abort: AbortController | null = null;
  private fetchedAt = 0;
  /** How often older rows came into a ring. */
  inserts = 0;

  constructor(
    readonly run: string,
    readonly signals: readonly Signal[],
    private readonly changed: () => void = () => {},
    private readonly fetchSamples: FetchSamples = (query, signal) => api.samples(run, query, signal),
    private readonly now: () => number = () => performance.now(),
  ) {
    this.byName = new Map(signals.map((signal) => [signal.name, signal]));
  }

  close(): void {
    this.abort?.abort();
    if (this.timer) clearTimeout(this.timer);
  }

  touch(): void {
    this.version++;
    this.changed();
  }

  /** Older rows came into a ring. */
  inserted(): void {
    this.inserts++;
    this.touch();
  }

  /** Changes when what is drawn of a window up to tick `to` may have changed: not with every new tick beyond it. */
  stamp(to: number): string {
    return `${this.fetchedAt} ${this.inserts} ${this.rings.length} ${Math.min(this.head, Math.ceil(to) + 1)}`;
  }

  /** The ring that carries a signal, and its column. */
  private ringOf(name: string): { ring: Ring; column: number } | null {
    const signal = this.byName.get(name);
    if (!signal) return null;
    for (const ring of this.rings) {
      const column = ring.signals.indexOf(signal.id);
      if (column >= 0 && ring.length) return { ring, column };
    }
    return null;
  }

  /** What the rings have of a signal after tick `from`; never asks for more. */
  recent(name: string, from: number): Series {
    const found = this.ringOf(name);
    return found ? ringSeries(found.ring, found.column, from, this.head) : emptySeries;
  }

  /** What is known of a signal between two ticks. What is not known yet is asked for, and comes with a later drawing. */
  get(name: string, from: number, to: number): Series {
    if (!this.byName.has(name)) return emptySeries;
    const found = this.ringOf(name);
    if (found && found.ring.first <= Math.max(0, from)) return ringSeries(found.ring, found.column, from, to);
    const until = found ? found.ring.first - 1 : this.head;
    this.want(name, Math.max(0, Math.floor(from)), Math.min(Math.ceil(to), this.head), until);
    const older = this.table?.series.get(name) ?? emptySeries;
    if (!found) return older;
    const newer = ringSeries(found.ring, found.column, from, to);
    return older.k.length && older.k[0]! < (newer.k[0] ?? Infinity) ? concatSeries(before(older, newer.k[0] ?? Infinity), newer) : newer;
  }

  /** Ids keep the address short. */
  private idsOf(names: readonly string[]): string {
    return names.map((name) => this.byName.get(name)?.id ?? name).join(',');
  }

  private want(name: string, from: number, to: number, until: number): void {
    this.wanted.set(name, this.now());
    if (to < from) return;
    this.asked = { from, to };
    const table = this.table;
    const reaches = table && table.series.has(name) && table.from <= from && table.to >= Math.min(to, until);
    const fine = table && (table.raw || table.to - table.from <= 2.5 * Math.max(1, to - from));
    if (reaches && fine) return;
    if (this.timer || this.loading) return;
    const soon = table && table.series.has(name) && this.growing ? Math.max(60, this.fetchedAt + refreshMs - this.now()) : 40;
    this.timer = setTimeout(() => {
      this.timer = null;
      void this.load();
    }, soon);
  }

  private async load(): Promise<void> {
    const asked = this.asked;
    if (!asked) return;
    for (const [name, at] of this.wanted) if (this.now() - at > forgetMs) this.wanted.delete(name);
    const names = [...this.wanted.keys()];
    this.loading = true;
    this.abort = new AbortController();
    // A little more on both sides, so that a small move needs no call.
    const margin = Math.round((asked.to - asked.from) * 0.1);
    const from = Math.max(0, asked.from - margin);
    const to = Math.min(this.head, asked.to + margin);
    try {
      const series = new Map<string, Series>();
      let raw = true;
      for (let i = 0; i < names.length; i += signalsPerCall) {
        const part = names.slice(i, i + signalsPerCall);
        const samples = await this.fetchSamples({ signals: this.idsOf(part), from, to, points: windowPoints }, this.abort.signal);
        for (const [name, one] of samplesSeries(samples)) {
          series.set(name, one);
          raw &&= one.lo === one.hi;
        }
        for (const name of part) if (!series.has(name)) series.set(name, emptySeries);
      }
      this.table = { from, to, raw, series };
      this.failure = null;
    } catch (error) {
      if (!(error instanceof DOMException && error.name === 'AbortError')) this.failure = error;
      // Kept from asking again at once.
      await new Promise((resolve) => setTimeout(resolve, refreshMs));
    }
    this.loading = false;
    this.fetchedAt = this.now();
    this.touch();
  }

  /** Raw rows of all signals of a ring for [from, to], from the log. */
  async rows(ring: Ring, from: number, to: number): Promise<Frame[]> {
    const names = ring.signals.map((id) => this.signals[id]?.name ?? '');
    const calls: string[][] = [];
    for (let i = 0; i < names.length; i += signalsPerCall) calls.push(names.slice(i, i + signalsPerCall));
    const abort = new AbortController();
    const parts = await Promise.all(calls.map((part) => this.fetchSamples({ signals: this.idsOf(part), from, to, points: to - from + 2 }, abort.signal)));
    return framesOf(parts, calls, names.length);
  }
}

function before(series: Series, k: number): Series {
  let end = series.k.length;
  while (end > 0 && series.k[end - 1]! >= k) end--;
  return {
    k: series.k.subarray(0, end),
    lo: series.lo.subarray(0, end),
    hi: series.lo === series.hi ? series.lo.subarray(0, end) : series.hi.subarray(0, end),
    joined: series.joined.subarray(0, end),
  };
}

/** Frames from answers that each hold some of the columns. Only ticks that every answer has. */
export function framesOf(parts: readonly Samples[], names: readonly (readonly string[])[], width: number): Frame[] {
  const first = parts[0];
  if (!first) return [];
  const rows = new Map<number, Frame>();
  let step = 1;
  for (let i = 1; i < first.k.length; i++) step = i === 1 ? first.k[1]! - first.k[0]! : Math.min(step, first.k[i]! - first.k[i - 1]!);
  for (const k of first.k) rows.set(k, { k, t: NaN, n: step, v: new Float32Array(width).fill(NaN) });
  let offset = 0;
  parts.forEach((part, p) => {
    const byName = new Map(part.series.map((series) => [series.signal, series]));
    (names[p] ?? []).forEach((name, c) => {
      const series = byName.get(name);
      if (!series) return;
      const values = 'v' in series ? series.v : series.hi;
      part.k.forEach((k, i) => {
        const row = rows.get(k);
        if (row) row.v[offset + c] = values[i] ?? NaN;
      });
    });
    offset += names[p]?.length ?? 0;
  });
  return [...rows.values()];
}
