/// One campaign and how it goes on: progress from the feed, figures of the chosen metric read anew now and then.
import { campaigns, isOpen, type CampaignDetail, type CellResult, type Statistics } from '../../api/campaigns';
import { ApiProblem } from '../../api/problem';
import { noted, type CampaignNote } from './feed';
import { doneOf, firstMetric, resultsOf, takeFigures, type Results } from './stats';

/** Figures of a campaign that runs are read anew at most this often, ms; more seldom where reading them takes long. */
const kOften = 3000;
/** Share of the time that reading may take. */
const kShare = 8;
/** Its outline, which names new metrics and warnings, is read with so many of these. */
const kOutline = 10;

export class CampaignWatch {
  detail = $state.raw<CampaignDetail | null>(null);
  /** Figures of the chosen metric. */
  results = $state.raw<Results | null>(null);
  /** Paired differences and detection curves of the chosen cell. */
  cell = $state.raw<CellResult | null>(null);
  problem = $state.raw<unknown>(null);
  gone = $state(false);
  #abort = new AbortController();
  #reading = false;
  #again = false;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #rounds = 0;
  #cell = 0;
  #cellDone = -1;
  #metric: string;
  #table = new Map<string, Statistics>();
  /** Cells before it are whole and read. */
  #from = 0;

  constructor(
    readonly id: string,
    metric: string,
  ) {
    this.#metric = metric;
  }

  /** Everything: when the page opens, and when the state has changed. */
  load(): Promise<void> {
    this.#rounds = 0;
    return this.#read();
  }

  /** The metric that is shown; "": whichever comes first. */
  async want(metric: string): Promise<void> {
    if (metric === this.#metric) return;
    this.#metric = metric;
    this.#table = new Map();
    this.#from = 0;
    await this.#guarded(() => this.#readFigures());
  }

  async choose(cell: number): Promise<void> {
    if (cell === this.#cell && this.cell) return;
    this.#cell = cell;
    this.cell = null;
    await this.#guarded(() => this.#readCell(true));
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

  async #read(): Promise<void> {
    if (this.#reading) {
      this.#again = true;
      return;
    }
    this.#reading = true;
    const begun = performance.now();
    await this.#guarded(async () => {
      if (!this.detail || this.#rounds % kOutline === 0 || this.detail.names.metrics.length === 0) this.detail = await campaigns.one(this.id, this.#abort.signal);
      await this.#readFigures();
      await this.#readCell(false);
      this.problem = null;
    });
    this.#rounds++;
    this.#reading = false;
    if (this.#abort.signal.aborted) return;
    const wait = this.#again ? 0 : Math.max(kOften, kShare * (performance.now() - begun));
    clearTimeout(this.#timer);
    if (this.#again || (this.detail && isOpen(this.detail.state) && this.detail.state !== 'paused')) this.#timer = setTimeout(() => void this.#read(), wait);
    this.#again = false;
  }

  async #guarded(work: () => Promise<void>): Promise<void> {
    try {
      await work();
    } catch (error) {
      if (this.#abort.signal.aborted) return;
      if (error instanceof ApiProblem && error.status === 404) this.gone = true;
      else this.problem = error;
    }
  }

  async #readFigures(): Promise<void> {
    const detail = this.detail;
    if (!detail) return;
    const { metrics } = detail.names;
    const metric = metrics.some(({ id }) => id === this.#metric) ? this.#metric : firstMetric(metrics);
    const table = this.#table;
    if (metric) {
      const answer = await campaigns.results(this.id, metric, this.#from, this.#abort.signal);
      if (table !== this.#table) return;
      takeFigures(table, answer);
      this.#from = Math.floor(answer.done / detail.runs);
    }
    this.results = resultsOf(detail.names, table);
  }

  async #readCell(anew: boolean): Promise<void> {
    const cell = this.#cell;
    const done = this.detail ? doneOf(this.detail, cell) : 0;
    if (!anew && done === this.#cellDone && this.cell) return;
    const result = done > 0 || anew ? await campaigns.cell(this.id, cell, this.#abort.signal) : null;
    if (cell !== this.#cell) return;
    this.cell = result;
    this.#cellDone = done;
  }
}
