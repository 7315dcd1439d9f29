/// The comparison that belongs to the question in the address; the newest question wins.
import { api, get } from '../../api/client';
import type { Question } from './question';
import { leastRuns } from './question';
import type { Comparison } from './types';

/** Buckets of a chart: about its width in px. */
const kPoints = 600;

export class Asked {
  comparison = $state.raw<Comparison | null>(null);
  problem = $state.raw<unknown>(null);
  loading = $state(false);
  /** Names of the base's signals. */
  names = $state.raw<readonly string[]>([]);
  #abort = new AbortController();
  #base = '';

  async ask({ ids, ...rest }: Question): Promise<void> {
    this.#abort.abort();
    const abort = (this.#abort = new AbortController());
    if (ids.length < leastRuns) {
      this.comparison = null;
      this.problem = null;
      this.loading = false;
      return;
    }
    this.loading = true;
    void this.#offer(ids[0]!, abort.signal);
    try {
      const comparison = await get<Comparison>('/compare', { ids: ids.join(','), ...rest, points: kPoints }, abort.signal);
      if (abort.signal.aborted) return;
      this.comparison = comparison;
      this.problem = null;
    } catch (error) {
      if (abort.signal.aborted) return;
      this.problem = error;
    }
    this.loading = false;
  }

  /** Without names nothing is offered; that is all. */
  async #offer(base: string, signal: AbortSignal): Promise<void> {
    if (base === this.#base || !/^\d+$/.test(base)) return;
    try {
      const signals = await api.signals(base, signal);
      if (signal.aborted) return;
      this.#base = base;
      this.names = signals.filter((one) => one.logged !== false).map((one) => one.name);
    } catch {
      return;
    }
  }

  close(): void {
    this.#abort.abort();
  }
}
