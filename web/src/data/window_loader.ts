/// Windows of samples fetched from the log: what several panels want of the same window goes in one call. Panels that look
/// at different places each keep theirs: otherwise they would drive each other away, and ask for ever.
import type { Samples } from '../api/types';
import { emptySeries, samplesSeries, type Series } from './series';

/** Points asked of the server for a window: about one a pixel of a wide screen. */
export const windowPoints = 1200;
export const signalsPerCall = 200;
const refreshMs = 1000;
const forgetMs = 3000;
/** Windows kept, and wishes for more of them. */
const most = 4;

export interface Table {
  from: number;
  to: number;
  raw: boolean;
  series: Map<string, Series>;
}

interface Range {
  from: number;
  to: number;
}

export interface LoaderOptions {
  fetch: (names: readonly string[], from: number, to: number, signal: AbortSignal) => Promise<Samples>;
  /** Newest tick there is. */
  head: () => number;
  growing: () => boolean;
  loaded: () => void;
  now: () => number;
  /** Signals that one call may ask for. */
  signalsPerCall?: number;
  /** The window that is fetched for a wish: somewhat more, so that a small move needs no call. */
  widen: (from: number, to: number) => { from: number; to: number };
}

export class WindowLoader {
  failure: unknown = null;
  fetchedAt = 0;
  private readonly wanted = new Map<string, number>();
  /** Newest first. */
  private tables: Table[] = [];
  private wishes: Range[] = [];
  private timer: ReturnType<typeof setTimeout> | null = null;
  private loading = false;
  private readonly abort = new AbortController();

  constructor(private readonly options: LoaderOptions) {}

  close(): void {
    this.abort.abort();
    if (this.timer) clearTimeout(this.timer);
  }

  /** What is there of a signal now. If it does not hold [from, to], at least up to `until`, finely enough, that is fetched. */
  get(name: string, from: number, to: number, until: number): Series {
    this.wanted.set(name, this.options.now());
    const having = this.tables.filter((table) => table.series.has(name));
    const whole = having.find((table) => holds(table, from, Math.min(to, until)));
    if (whole) return whole.series.get(name)!;
    if (to >= from) {
      this.wish(from, to);
      this.soon(having.length > 0);
    }
    // Something of the window is better than nothing of it.
    const part = having.find((table) => table.from <= to && table.to >= from) ?? having[0];
    return part?.series.get(name) ?? emptySeries;
  }

  /** Wishes that meet are one. */
  private wish(from: number, to: number): void {
    const met = this.wishes.filter((wish) => wish.from <= to && wish.to >= from);
    const wish = { from: Math.min(from, ...met.map((one) => one.from)), to: Math.max(to, ...met.map((one) => one.to)) };
    this.wishes = [wish, ...this.wishes.filter((one) => !met.includes(one))].slice(0, most);
  }

  private soon(refresh: boolean): void {
    if (this.timer || this.loading) return;
    const wait = refresh && this.options.growing() ? Math.max(60, this.fetchedAt + refreshMs - this.options.now()) : 40;
    this.timer = setTimeout(() => {
      this.timer = null;
      void this.load();
    }, wait);
  }

  private async load(): Promise<void> {
    const wishes = this.wishes;
    this.wishes = [];
    if (!wishes.length) return;
    const { now, head, widen } = this.options;
    for (const [name, at] of this.wanted) if (now() - at > forgetMs) this.wanted.delete(name);
    this.loading = true;
    const before = this.tables;
    const fetched: Table[] = [];
    try {
      for (const wish of wishes) {
        const wide = widen(wish.from, wish.to);
        fetched.push(await this.fetchTable([...this.wanted.keys()], Math.max(0, wide.from), Math.min(head(), wide.to)));
        this.tables = [...fetched, ...before].slice(0, most);
        if (fetched.length < wishes.length) this.options.loaded();
      }
      this.failure = null;
    } catch (error) {
      if (this.abort.signal.aborted) return;
      this.failure = error;
      // Kept from asking again at once.
      await new Promise((resolve) => setTimeout(resolve, refreshMs));
    }
    this.loading = false;
    // What is still lacking is wished for again by the drawing that follows.
    this.wishes = [];
    this.fetchedAt = now();
    this.options.loaded();
  }

  private async fetchTable(names: readonly string[], from: number, to: number): Promise<Table> {
    const series = new Map<string, Series>();
    let raw = true;
    const each = this.options.signalsPerCall ?? signalsPerCall;
    for (let i = 0; i < names.length; i += each) {
      const part = names.slice(i, i + each);
      for (const [name, one] of samplesSeries(await this.options.fetch(part, from, to, this.abort.signal))) {
        series.set(name, one);
        raw &&= one.lo === one.hi;
      }
      for (const name of part) if (!series.has(name)) series.set(name, emptySeries);
    }
    return { from, to, raw, series };
  }
}

/** Whether a table has [from, to], finely enough. */
function holds(table: Table, from: number, to: number): boolean {
  return table.from <= from && table.to >= to && (table.raw || table.to - table.from <= 2.5 * Math.max(1, to - from));
}
