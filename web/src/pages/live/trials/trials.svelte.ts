/// The finished runs of one scenario in this log, read when somebody looks, and more of them on demand.
import { api } from '../../../api/client';
import { isLive, type RunDetail, type RunItem } from '../../../api/types';
import { quoted } from '../../runs/query';
import { freeSeeds, trialsOf } from './trials';

/** Runs are read so many at a time, the newest first. */
const page = 100;
export const mostRuns = 300;
const askMs = 400;

export class Trials {
  trials = $state.raw<readonly RunItem[]>([]);
  loaded = $state(false);
  failure = $state.raw<unknown>(null);
  /** Runs on their way, of those that were asked for. */
  making = $state.raw<{ done: number; all: number } | null>(null);
  private closed = false;
  private seeds: number[] = [];

  constructor(
    private readonly hash: string,
    private readonly scenario: string,
  ) {}

  close(): void {
    this.closed = true;
  }

  async load(): Promise<void> {
    try {
      const runs: RunItem[] = [];
      let cursor: string | undefined;
      do {
        const { items, next } = await api.runs({ q: `scenario:${quoted(this.scenario)} AND state:finished`, limit: page, cursor });
        runs.push(...items);
        cursor = next ?? undefined;
      } while (cursor && runs.length < mostRuns && !this.closed);
      this.trials = trialsOf(runs, this.hash);
      this.seeds = runs.filter((run) => run.document_hash === this.hash).map((run) => run.seed);
      this.failure = null;
      this.loaded = true;
    } catch (error) {
      this.failure = error;
    }
  }

  /** Starts `count` runs of the document, one after the other, and reads the log again when they are over. */
  async more(run: Pick<RunDetail, 'document'>, count: number): Promise<void> {
    if (this.making) return;
    this.making = { done: 0, all: count };
    try {
      for (const seed of freeSeeds(this.seeds, count)) {
        const { id } = await api.start({ scenario: run.document, seed, pace: 'max', tags: ['trials'] });
        while (!this.closed && isLive((await api.run(id)).state)) await new Promise((resolve) => setTimeout(resolve, askMs));
        if (this.closed) break;
        this.making = { done: this.making.done + 1, all: count };
      }
      if (!this.closed) await this.load();
    } catch (error) {
      this.failure = error;
    }
    this.making = null;
  }
}
