/// One campaign and how it goes on: progress from the feed, results read anew now and then.
import { campaigns, isOpen, type CampaignDetail, type CellResult } from '../../api/campaigns';
import { ApiProblem } from '../../api/problem';
import { noted, type CampaignNote } from './feed';

/** Results of a campaign that runs are read anew at most this often, ms; more seldom where reading them takes long. */
const kOften = 3000;
/** Share of the time that reading may take. */
const kShare = 8;

export class CampaignWatch {
  detail = $state.raw<CampaignDetail | null>(null);
  /** Paired differences and detection curves of the chosen cell. */
  cell = $state.raw<CellResult | null>(null);
  problem = $state.raw<unknown>(null);
  gone = $state(false);
  #abort = new AbortController();
  #reading = false;
  #again = false;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #cell = 0;
  #cellDone = -1;

  constructor(readonly id: string) {}

  async load(): Promise<void> {
    if (this.#reading) {
      this.#again = true;
      return;
    }
    this.#reading = true;
    const begun = performance.now();
    try {
      this.detail = await campaigns.one(this.id, this.#abort.signal);
      this.problem = null;
      await this.#readCell(false);
    } catch (error) {
      if (!this.#abort.signal.aborted) this.#failed(error);
    }
    this.#reading = false;
    if (this.#abort.signal.aborted) return;
    const wait = this.#again ? 0 : Math.max(kOften, kShare * (performance.now() - begun));
    clearTimeout(this.#timer);
    if (this.#again || (this.detail && isOpen(this.detail.state) && this.detail.state !== 'paused')) this.#timer = setTimeout(() => void this.load(), wait);
    this.#again = false;
  }

  async choose(cell: number): Promise<void> {
    if (cell === this.#cell && this.cell) return;
    this.#cell = cell;
    this.cell = null;
    try {
      await this.#readCell(true);
    } catch (error) {
      if (!this.#abort.signal.aborted) this.#failed(error);
    }
  }

  heard(note: CampaignNote): void {
    if (note.id !== this.id) return;
    if (note.state === 'deleted') {
      this.gone = true;
      return;
    }
    if (!this.detail) return;
    const before = this.detail.state;
    this.detail = noted(this.detail, note);
    if (before !== note.state) void this.load();
  }

  close(): void {
    this.#abort.abort();
    clearTimeout(this.#timer);
  }

  #failed(error: unknown): void {
    if (error instanceof ApiProblem && error.status === 404) this.gone = true;
    else this.problem = error;
  }

  async #readCell(anew: boolean): Promise<void> {
    const cell = this.#cell;
    const done = this.detail?.cells.find((one) => one.cell === cell)?.done ?? 0;
    if (!anew && done === this.#cellDone && this.cell) return;
    const result = done > 0 || anew ? await campaigns.cell(this.id, cell, this.#abort.signal) : null;
    if (cell !== this.#cell) return;
    this.cell = result;
    this.#cellDone = done;
  }
}
