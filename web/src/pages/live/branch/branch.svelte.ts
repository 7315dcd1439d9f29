/// Another branch of the run on the screen, drawn over it: a fork, or what it was forked from. Kept in the address.
import { api } from '../../../api/client';
import { isLive, type RunDetail, type RunItem } from '../../../api/types';
import { loop } from '../../../chart/loop';
import type { Series } from '../../../data/series';
import { Source } from '../../../data/source';
import { readQuery, setQuery } from '../../../router/router.svelte';
import { lineOf, type ReadLine } from '../lines';
import { after, drawnBy } from './lines';
import { forkTick } from './relation';

const refreshMs = 1000;
const mostForks = 20;

/** The run that is drawn over ours. */
export interface Other {
  run: RunDetail;
  source: Source;
  /** Its curves begin here. */
  from: number;
}

export class Branches {
  /** Runs that were forked from ours, newest first. */
  forks = $state.raw<RunItem[]>([]);
  other = $state.raw<Other | null>(null);
  failure = $state.raw<unknown>(null);
  /** Asked for, whether it is there yet or not. */
  wanted = $state<string | null>(readQuery('with'));
  /** The run asked for is no branch of ours. */
  foreign = $state(false);
  private timer: ReturnType<typeof setInterval> | null = null;
  private closed = false;

  constructor(private readonly id: string) {
    void this.findForks();
    if (this.wanted !== null) void this.load(this.wanted);
  }

  close(): void {
    this.closed = true;
    this.drop();
  }

  async findForks(): Promise<void> {
    try {
      this.forks = (await api.runs({ q: `parent:${this.id}`, limit: mostForks })).items;
    } catch {
      // Nothing is offered; the run itself is not touched by it.
      this.forks = [];
    }
  }

  /** Draws a branch over the run; again, or null: none. */
  show(id: string | null): void {
    const next = id === this.wanted ? null : id;
    this.drop();
    this.wanted = next;
    setQuery({ with: next });
    if (next !== null) void this.load(next);
    loop.data();
  }

  private drop(): void {
    if (this.timer) clearInterval(this.timer);
    this.timer = null;
    this.other?.source.close();
    this.other = null;
    this.failure = null;
    this.foreign = false;
  }

  private async load(id: string): Promise<void> {
    try {
      const [mine, run, signals] = await Promise.all([api.run(this.id), api.run(id), api.signals(id)]);
      if (this.closed || this.wanted !== id) return;
      const from = forkTick(mine, run);
      if (from === null) {
        this.foreign = true;
        return;
      }
      const source = new Source(id, signals, () => loop.data());
      source.head = run.progress.k;
      source.growing = isLive(run.state);
      this.other = { run, source, from };
      if (source.growing) this.timer = setInterval(() => void this.refresh(), refreshMs);
      loop.data();
    } catch (error) {
      if (!this.closed && this.wanted === id) this.failure = error;
    }
  }

  /** A branch that goes on grows on our screen as well. */
  private async refresh(): Promise<void> {
    const other = this.other;
    if (!other || document.hidden) return;
    try {
      const run = await api.run(other.run.id);
      if (this.other !== other) return;
      other.source.head = Math.max(other.source.head, run.progress.k);
      other.source.growing = isLive(run.state);
      if (!other.source.growing && this.timer) clearInterval(this.timer);
      loop.data();
    } catch {
      // Asked again with the next second.
    }
  }

  /** Changes when what is drawn of the other branch may have changed. */
  get version(): string {
    return this.other ? `${this.other.run.id} ${this.other.source.fetched}` : '';
  }

  /** The other branch's values of a line of ours, from the fork on; null: it does not have them. */
  read(line: ReadLine): ((from: number, to: number) => Series) | null {
    const other = this.other;
    if (!other || !drawnBy(line, other.source)) return null;
    return (from, to) => after(lineOf(line, other.source, Math.max(from, other.from), Math.max(to, other.from)), other.from);
  }
}
