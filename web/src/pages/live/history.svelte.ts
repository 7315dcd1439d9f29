/// Signals of a run from its first tick on, every tick at full precision: what rates and densities are made of.
import { api } from '../../api/client';
import type { Samples } from '../../api/types';

/** Only so many of the newest ticks are read. */
export const mostTicks = 50_000;
const everyMs = 1000;

interface Where {
  id: string;
  source: { head: number; byName: ReadonlyMap<string, { id: number }> } | null;
}

type Fetch = (run: string, query: { signals: string; from: number; to: number; points: number }, signal: AbortSignal) => Promise<Samples>;

export class History {
  readonly k: number[] = [];
  readonly columns: Map<string, number[]>;
  /** Grows with every piece that came. */
  version = $state(0);
  /** Whether everything up to the newest tick at that time was read at least once. */
  whole = $state(false);
  failure = $state.raw<unknown>(null);
  private loading = false;
  private closed = false;
  private readonly abort = new AbortController();

  constructor(
    private readonly where: Where,
    readonly names: readonly string[],
    private readonly fetchSamples: Fetch = api.samples,
  ) {
    this.columns = new Map(names.map((name) => [name, []]));
  }

  column(name: string): readonly number[] {
    return this.columns.get(name) ?? [];
  }

  /** Reads what is there, and goes on as the run does. Answers how to stop. */
  follow(): () => void {
    void this.update();
    const timer = setInterval(() => void this.update(), everyMs);
    return () => {
      clearInterval(timer);
      this.closed = true;
      this.abort.abort();
    };
  }

  async update(): Promise<void> {
    const head = this.where.source?.head ?? -1;
    const from = (this.k.at(-1) ?? Math.max(-1, head - mostTicks)) + 1;
    if (this.loading || this.closed || from > head || !this.names.length) return;
    this.loading = true;
    try {
      const ids = this.names.map((name) => this.where.source?.byName.get(name)?.id ?? name);
      this.take(await this.fetchSamples(this.where.id, { signals: ids.join(), from, to: head, points: Math.max(2, head - from + 2) }, this.abort.signal));
      this.failure = null;
    } catch (error) {
      if (!this.closed) this.failure = error;
    }
    this.loading = false;
  }

  private take(samples: Samples): void {
    if (this.closed) return;
    const last = this.k.at(-1) ?? -1;
    const rows = [...samples.k.keys()].filter((i) => samples.k[i]! > last);
    for (const i of rows) this.k.push(samples.k[i]!);
    for (const series of samples.series) {
      const values = 'v' in series ? series.v : series.hi;
      const column = this.columns.get(series.signal);
      for (const i of rows) column?.push(values[i] ?? NaN);
    }
    this.whole = true;
    if (rows.length) this.version++;
  }
}
