/// Windows of samples fetched from the log, one at a time: what several panels want of the same window goes in one call.
import type { Samples } from '../api/types';
import { emptySeries, samplesSeries, type Series } from './series';

/** Points asked of the server for a window: about one a pixel of a wide screen. */
export const windowPoints = 1200;
export const signalsPerCall = 200;
const refreshMs = 1000;
const forgetMs = 3000;

export interface Table {
  from: number;
  to: number;
  raw: boolean;
  series: Map<string, Series>;
}

export interface LoaderOptions {
  fetch: (names: readonly string[], from: number, to: number, signal: AbortSignal) => Promise<Samples>;
  /** Newest tick there is. */
  head: () => number;
  growing: () => boolean;
  loaded: () => void;
  now: () => number;
  /** The window that is fetched for a wish: somewhat more, so that a small move needs no call. */
  widen: (from: number, to: number) => { from: number; to: number };
}

export class WindowLoader {
  table: Table | null = null;
  failure: unknown = null;
  fetchedAt = 0;
  private readonly wanted = new Map<string, number>();
  private asked: { from: number; to: number } | null = null;
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
    const held = this.table?.series.get(name);
    if (to >= from) {
      this.asked = { from, to };
      if (!this.holds(name, from, Math.min(to, until))) this.soon(held !== undefined);
    }
    return held ?? emptySeries;
  }

  private holds(name: string, from: number, to: number): boolean {
    const table = this.table;
    if (!table || !table.series.has(name) || table.from > from || table.to < to) return false;
    return table.raw || table.to - table.from <= 2.5 * Math.max(1, to - from);
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
    if (!this.asked) return;
    const { now, head, widen } = this.options;
    for (const [name, at] of this.wanted) if (now() - at > forgetMs) this.wanted.delete(name);
    const wide = widen(this.asked.from, this.asked.to);
    const from = Math.max(0, wide.from);
    const to = Math.min(head(), wide.to);
    this.loading = true;
    try {
      this.table = await this.fetchTable([...this.wanted.keys()], from, to);
      this.failure = null;
    } catch (error) {
      if (this.abort.signal.aborted) return;
      this.failure = error;
      // Kept from asking again at once.
      await new Promise((resolve) => setTimeout(resolve, refreshMs));
    }
    this.loading = false;
    this.fetchedAt = now();
    this.options.loaded();
  }

  private async fetchTable(names: readonly string[], from: number, to: number): Promise<Table> {
    const series = new Map<string, Series>();
    let raw = true;
    for (let i = 0; i < names.length; i += signalsPerCall) {
      const part = names.slice(i, i + signalsPerCall);
      for (const [name, one] of samplesSeries(await this.options.fetch(part, from, to, this.abort.signal))) {
        series.set(name, one);
        raw &&= one.lo === one.hi;
      }
      for (const name of part) if (!series.has(name)) series.set(name, emptySeries);
    }
    return { from, to, raw, series };
  }
}
