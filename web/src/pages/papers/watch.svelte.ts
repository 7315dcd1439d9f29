/// The items and the job, as the server has them: asked again about once a second while a job goes on.
import { papers, type PaperItem, type PapersJob, type PapersOrder } from '../../api/papers';

export const pollMs = 1000;

export class PapersWatch {
  items = $state.raw<PaperItem[]>([]);
  job = $state.raw<PapersJob | null>(null);
  loading = $state(true);
  cancelling = $state(false);
  /** The list could not be had. */
  problem = $state.raw<unknown>(null);
  /** What was asked for was refused. */
  refusal = $state.raw<unknown>(null);
  #timer: ReturnType<typeof setTimeout> | undefined;
  #abort = new AbortController();

  readonly report = papers.reportAddress();

  get running(): boolean {
    return this.job?.state === 'running';
  }

  async load(): Promise<void> {
    clearTimeout(this.#timer);
    const { signal } = this.#abort;
    try {
      const list = await papers.list(signal);
      this.items = list.items;
      this.job = list.job;
      this.problem = null;
    } catch (error) {
      if (signal.aborted) return;
      this.problem = error;
    }
    this.loading = false;
    clearTimeout(this.#timer);
    if (!signal.aborted && this.running) this.#timer = setTimeout(() => void this.load(), pollMs);
  }

  async start(order: PapersOrder): Promise<void> {
    await this.#ask(async () => {
      this.job = await papers.start(order);
    });
  }

  async cancel(): Promise<void> {
    this.cancelling = true;
    await this.#ask(() => papers.cancel());
    this.cancelling = false;
  }

  close(): void {
    clearTimeout(this.#timer);
    this.#abort.abort();
  }

  async #ask(what: () => Promise<void>): Promise<void> {
    try {
      await what();
      this.refusal = null;
    } catch (error) {
      this.refusal = error;
    }
    await this.load();
  }
}
