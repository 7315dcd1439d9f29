import { api } from '../../api/client';
import { ApiProblem } from '../../api/problem';
import type { RunItem } from '../../api/types';
import type { RunNote } from './feed';
import { appended, replaced } from './table';

const kPage = 100;

/** The runs that match a query, page by page, kept up to date. Rows are plain values: samples never come here. */
export class RunsList {
  items = $state.raw<RunItem[]>([]);
  next = $state.raw<string | null>(null);
  loading = $state(true);
  /** The last call that failed; null once one has succeeded. */
  problem = $state.raw<unknown>(null);
  #query = { q: '', sort: '' };
  #abort = new AbortController();
  /** Settled once no page is on its way. */
  #arrived: Promise<void> = Promise.resolve();
  /** Settled once what was heard so far is in the list. */
  #told: Promise<void> = Promise.resolve();

  /** The first page for another query or order. */
  load(q: string, sort: string): Promise<void> {
    return (this.#arrived = this.#load(q, sort));
  }

  async #load(q: string, sort: string): Promise<void> {
    this.#query = { q, sort };
    this.#abort.abort();
    const abort = (this.#abort = new AbortController());
    this.loading = true;
    try {
      const page = await api.runs({ q, sort, limit: kPage }, abort.signal);
      if (abort.signal.aborted) return;
      this.items = page.items;
      this.next = page.next;
      this.problem = null;
    } catch (error) {
      if (abort.signal.aborted) return;
      this.items = [];
      this.next = null;
      this.problem = error;
    }
    this.loading = false;
  }

  reload(): Promise<void> {
    return this.load(this.#query.q, this.#query.sort);
  }

  /** The page after what is there. */
  more(): Promise<void> {
    if (this.next === null || this.loading) return Promise.resolve();
    return (this.#arrived = this.#more(this.next));
  }

  async #more(cursor: string): Promise<void> {
    const abort = this.#abort;
    this.loading = true;
    try {
      const page = await api.runs({ ...this.#query, limit: kPage, cursor }, abort.signal);
      if (abort.signal.aborted) return;
      this.items = appended(this.items, page.items);
      this.next = page.next;
      this.problem = null;
    } catch (error) {
      if (abort.signal.aborted) return;
      this.problem = error;
    }
    this.loading = false;
  }

  /**
   * Something happened to a run: its row becomes what the server says now; a new run shows where the list is newest first.
   * One note after the other, and none while a page is on its way: that page may have been made before the note.
   */
  heard(note: RunNote): Promise<void> {
    return (this.#told = this.#told.then(async () => {
      await this.#arrived;
      await this.#hear(note);
    }));
  }

  async #hear(note: RunNote): Promise<void> {
    const known = this.items.find((item) => item.id === note.id);
    if (note.state === 'deleted') {
      this.drop(new Set([note.id]));
    } else if (known && known.state === note.state) {
      const { k, t, ticks_per_second } = { ...known.progress, ...note };
      this.put({ ...known, progress: { ...known.progress, k, t, ticks_per_second } });
    } else if (known) {
      await this.#fetch(note.id);
    } else if (this.#query.q === '' && this.#query.sort === '') {
      await this.#newest();
    }
  }

  /** A load that begins meanwhile knows more than this answer. */
  async #fetch(id: string): Promise<void> {
    const abort = this.#abort;
    try {
      const run = await api.run(id);
      if (!abort.signal.aborted) this.put(run);
    } catch (error) {
      if (error instanceof ApiProblem && error.status === 404) this.drop(new Set([id]));
    }
  }

  /** Runs that are newer than those in the list, put before them. */
  async #newest(): Promise<void> {
    const abort = this.#abort;
    try {
      const page = await api.runs({ limit: 20 }, abort.signal);
      if (!abort.signal.aborted) this.items = appended(page.items, this.items);
    } catch {
      return;
    }
  }

  /** Every run of the query up to a number, for a file; tells how far it is. */
  async collect(most: number, progress: (n: number) => void): Promise<{ runs: RunItem[]; complete: boolean }> {
    let runs: RunItem[] = [];
    let cursor: string | undefined;
    do {
      const page = await api.runs({ ...this.#query, limit: 500, cursor });
      runs = appended(runs, page.items);
      cursor = page.next ?? undefined;
      progress(runs.length);
    } while (cursor !== undefined && runs.length < most);
    return { runs, complete: cursor === undefined };
  }

  drop(ids: ReadonlySet<string>): void {
    this.items = this.items.filter((item) => !ids.has(item.id));
  }

  put(run: RunItem): void {
    this.items = replaced(this.items, run);
  }

  close(): void {
    this.#abort.abort();
  }
}
