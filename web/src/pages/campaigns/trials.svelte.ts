/// The trials of one point: all values of a metric for the drawing, and the first of them for the list.
import { campaigns, type TrialItem } from '../../api/campaigns';
import { ApiProblem } from '../../api/problem';

/** As many as are drawn. */
const kMost = 10_000;
/** Trials of a point that is under way are read anew at most this often, ms. */
const kOften = 3000;

export interface TrialValue {
  index: number;
  value: number;
}

export class TrialsOf {
  /** Those that have the metric, in order of their index. */
  values = $state.raw<TrialValue[]>([]);
  /** The farthest from the median first. */
  items = $state.raw<TrialItem[]>([]);
  /** Those that failed or lost a lane. */
  broken = $state.raw<TrialItem[]>([]);
  problem = $state.raw<unknown>(null);
  loading = $state(false);
  #abort = new AbortController();
  #timer: ReturnType<typeof setTimeout> | undefined;
  #asked = '';
  #begun = -Infinity;

  /** `listed`: how many of the outliers. The same asked again soon waits. */
  ask(id: string, cell: number, metric: string, listed: number): void {
    clearTimeout(this.#timer);
    const key = `${id} ${cell} ${metric} ${listed}`;
    const rest = key === this.#asked ? this.#begun + kOften - performance.now() : 0;
    this.#asked = key;
    if (rest > 0) this.#timer = setTimeout(() => void this.#read(id, cell, metric, listed), rest);
    else void this.#read(id, cell, metric, listed);
  }

  async #read(id: string, cell: number, metric: string, listed: number): Promise<void> {
    this.#abort.abort();
    const { signal } = (this.#abort = new AbortController());
    this.#begun = performance.now();
    this.loading = true;
    try {
      const [values, far, failed, stopped] = await Promise.all([
        campaigns.values(id, { metrics: [metric], cell, limit: kMost }, signal),
        campaigns.trials(id, { cell, metric, sort: 'outlier', limit: listed }, signal),
        campaigns.trials(id, { cell, state: 'failed', limit: 20 }, signal),
        campaigns.trials(id, { cell, state: 'stopped', limit: 20 }, signal),
      ]);
      if (signal.aborted) return;
      this.values = (values.values[0] ?? []).flatMap((value, i) => (value === null ? [] : [{ index: values.from + i, value }]));
      this.items = far.items;
      this.broken = [...failed.items, ...stopped.items];
      this.problem = null;
    } catch (error) {
      if (signal.aborted) return;
      this.values = [];
      this.items = [];
      this.broken = [];
      // A lane without this metric has no values: the picture says so.
      this.problem = error instanceof ApiProblem && error.errors[0]?.pointer === '/metric' ? null : error;
    }
    this.loading = false;
  }

  close(): void {
    this.#abort.abort();
    clearTimeout(this.#timer);
  }
}

export function medianOf(values: readonly number[]): number | null {
  if (values.length === 0) return null;
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle]! : (sorted[middle - 1]! + sorted[middle]!) / 2;
}
