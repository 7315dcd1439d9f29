/// The trials of one point: all values of a metric for the drawing, and the first of them for the list.
import { campaigns, type TrialItem } from '../../api/campaigns';
import { ApiProblem } from '../../api/problem';

/** As many as the server gives at once. */
const kMost = 10_000;

export class TrialsOf {
  /** The farthest from the median first. */
  items = $state.raw<TrialItem[]>([]);
  /** Those that failed or lost a lane. */
  broken = $state.raw<TrialItem[]>([]);
  problem = $state.raw<unknown>(null);
  loading = $state(false);
  #abort = new AbortController();

  async ask(id: string, cell: number, metric: string): Promise<void> {
    this.#abort.abort();
    const { signal } = (this.#abort = new AbortController());
    this.loading = true;
    try {
      const [values, failed, stopped] = await Promise.all([
        campaigns.trials(id, { cell, metric, sort: 'outlier', limit: kMost }, signal),
        campaigns.trials(id, { cell, state: 'failed', limit: 20 }, signal),
        campaigns.trials(id, { cell, state: 'stopped', limit: 20 }, signal),
      ]);
      if (signal.aborted) return;
      this.items = values.items;
      this.broken = [...failed.items, ...stopped.items];
      this.problem = null;
    } catch (error) {
      if (signal.aborted) return;
      this.items = [];
      this.broken = [];
      // A lane without this metric has no values: the picture says so.
      this.problem = error instanceof ApiProblem && error.errors[0]?.pointer === '/metric' ? null : error;
    }
    this.loading = false;
  }

  close(): void {
    this.#abort.abort();
  }
}

export function medianOf(values: readonly number[]): number | null {
  if (values.length === 0) return null;
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle]! : (sorted[middle - 1]! + sorted[middle]!) / 2;
}
