/// Where panels get samples: the rings of the running streams first, else windows fetched from the log.
///
/// Nothing here is reactive. A panel asks at every drawing; what is lacking is fetched once and the panels are told.
import { api } from '../api/client';
import type { Samples, Signal } from '../api/types';
import type { Frame } from '../stream/events';
import type { Ring } from './ring';
import { concatSeries, emptySeries, ringSeries, type Series } from './series';
import { signalsPerCall, WindowLoader, windowPoints } from './window_loader';

/** Ticks fetched about a single tick start and end at multiples of this: a cursor that moves a little finds them there. */
const block = 64;
/** Ticks of the widest window that is fetched tick by tick, and signals of it that one call may ask for. */
const widest = 25_000;
const exactSignalsPerCall = 20;

type FetchSamples = (query: { signals: string; from: number; to: number; points: number }, signal: AbortSignal) => Promise<Samples>;

export class Source {
  readonly byName: Map<string, Signal>;
  rings: Ring[] = [];
  /** Newest tick known, -1: none. */
  head = -1;
  /** Whether `head` still grows. */
  growing = false;
  /** How often older rows came into a ring. */
  inserts = 0;

  private readonly windows: WindowLoader;
  private readonly states: WindowLoader;
  private readonly exacts: WindowLoader;

  constructor(
    readonly run: string,
    readonly signals: readonly Signal[],
    private readonly changed: () => void = () => {},
    private readonly fetchSamples: FetchSamples = (query, signal) => api.samples(run, query, signal),
    now: () => number = () => performance.now(),
  ) {
    this.byName = new Map(signals.map((signal) => [signal.name, signal]));
    const fetching = (points: number) => (names: readonly string[], from: number, to: number, signal: AbortSignal) => this.fetchSamples({ signals: this.idsOf(names), from, to, points }, signal);
    const common = {
      fetch: fetching(windowPoints),
      head: () => this.head,
      growing: () => this.growing,
      loaded: () => this.touch(),
      now,
    };
    this.windows = new WindowLoader({
      ...common,
      widen: (from, to) => {
        const margin = Math.ceil((to - from) * 0.1);
        return { from: from - margin, to: to + margin };
      },
    });
    this.states = new WindowLoader({ ...common, widen: (from, to) => ({ from: Math.floor(from / block) * block, to: Math.ceil((to + 1) / block) * block }) });
    this.exacts = new WindowLoader({ ...common, fetch: fetching(2 * widest), signalsPerCall: exactSignalsPerCall, widen: (from, to) => ({ from, to }) });
  }

  get failure(): unknown {
    return this.windows.failure ?? this.states.failure ?? this.exacts.failure;
  }

  close(): void {
    this.windows.close();
    this.states.close();
    this.exacts.close();
  }

  touch(): void {
    this.changed();
  }

  /** Older rows came into a ring. */
  inserted(): void {
    this.inserts++;
    this.touch();
  }

  /** Changes with every window that came. */
  get fetched(): string {
    return `${this.windows.fetchedAt} ${this.exacts.fetchedAt}`;
  }

  /** Changes when what is drawn of a window up to tick `to` may have changed: not with every new tick beyond it. */
  stamp(to: number): string {
    return `${this.windows.fetchedAt} ${this.exacts.fetchedAt} ${this.inserts} ${this.rings.length} ${Math.min(this.head, Math.ceil(to) + 1)}`;
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

  /** A signal over the window that is looked at. What is not known yet is asked for, and comes with a later drawing. */
  get(name: string, from: number, to: number): Series {
    return this.read(this.windows, name, from, to);
  }

  /**
   * Every tick of a window, for what is made of two signals: their extremes would not do. Extremes all the same until it is
   * there, of a run that goes on, and of a window too wide for that.
   */
  exact(name: string, from: number, to: number): Series {
    const wide = Math.min(to, this.head) - Math.max(0, from);
    if (this.growing || wide <= 0.8 * windowPoints || wide > widest) return this.get(name, from, to);
    const whole = this.read(this.exacts, name, from, to);
    return whole.k.length ? whole : this.get(name, from, to);
  }

  /** As the log has it, all signals at the same ticks: for what is made of a streamed signal and of one that is not. */
  logged(name: string, from: number, to: number): Series {
    if (!this.growing) return this.exact(name, from, to);
    return this.byName.has(name) ? this.windows.get(name, Math.max(0, Math.floor(from)), Math.min(Math.ceil(to), this.head), this.head) : emptySeries;
  }

  /** A signal about a single tick, or a short way up to it: every tick, however wide the window is. */
  near(name: string, from: number, to: number): Series {
    return this.read(this.states, name, from, to);
  }

  /** What the rings have of a signal after tick `from`; never asks for more. */
  recent(name: string, from: number): Series {
    const found = this.ringOf(name);
    return found ? ringSeries(found.ring, found.column, from, this.head) : emptySeries;
  }

  private read(loader: WindowLoader, name: string, from: number, to: number): Series {
    if (!this.byName.has(name)) return emptySeries;
    const found = this.ringOf(name);
    if (found && found.ring.first <= Math.max(0, from)) return ringSeries(found.ring, found.column, from, to);
    const until = found ? found.ring.first - 1 : this.head;
    const older = loader.get(name, Math.max(0, Math.floor(from)), Math.min(Math.ceil(to), this.head), until);
    if (!found) return older;
    const newer = ringSeries(found.ring, found.column, from, to);
    const begin = newer.k[0] ?? Infinity;
    return older.k.length && older.k[0]! < begin ? concatSeries(before(older, begin), newer) : newer;
  }

  /** Ids keep the address short. */
  private idsOf(names: readonly string[]): string {
    return names.map((name) => this.byName.get(name)?.id ?? name).join(',');
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

/** Frames from answers that each hold some of the columns. */
export function framesOf(parts: readonly Samples[], names: readonly (readonly string[])[], width: number): Frame[] {
  const first = parts[0];
  if (!first) return [];
  const rows = new Map<number, Frame>();
  let step = Infinity;
  for (let i = 1; i < first.k.length; i++) step = Math.min(step, first.k[i]! - first.k[i - 1]!);
  first.k.forEach((k, i) => rows.set(k, { k, t: first.t?.[i] ?? NaN, n: Number.isFinite(step) ? step : 1, v: new Float64Array(width).fill(NaN) }));
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
