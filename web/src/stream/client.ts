/// One stream of one run: opens, resumes where it stopped, waits longer after each failure, and notices silence.
///
/// A browser's EventSource never retries after a 204 or 503 and hides how long it waits, so every retry is made here.
import type { Mark, RunState } from '../api/types';
import { parseFrame, type Gap, type Hello, type StreamEvent } from './events';

export interface SourceLike {
  addEventListener(type: string, listener: (event: MessageEvent<string>) => void): void;
  close(): void;
}

export interface Probe {
  /** What the run is now; "gone": there is none; "unknown": no answer. */
  (): Promise<RunState | 'gone' | 'unknown'>;
}

export interface StreamOptions {
  /** Address without the resume point. */
  url: string;
  open: (url: string) => SourceLike;
  probe: Probe;
  emit: (event: StreamEvent) => void;
  now?: () => number;
  random?: () => number;
  later?: (callback: () => void, ms: number) => unknown;
  cancel?: (handle: unknown) => void;
}

const silenceMs = 25_000;
const busyMs = 5_000;

/** Wait before try number `tries` (1, 2, …): 1, 2, 4 … 30 s, less up to a quarter of it by chance. */
export function backoff(tries: number, random: number): number {
  const full = Math.min(30_000, 1000 * 2 ** Math.max(0, tries - 1));
  return Math.round(full * (1 - 0.25 * random));
}

export class StreamClient {
  private source: SourceLike | null = null;
  private lastId: string | null = null;
  private tries = 0;
  private timer: unknown = null;
  private watchdog: unknown = null;
  private closed = false;

  constructor(private readonly options: StreamOptions) {
    this.connect();
  }

  close(): void {
    this.closed = true;
    this.drop();
    this.clear('timer');
  }

  /** Tries at once instead of when the wait is over. */
  retryNow(): void {
    if (this.closed || this.timer === null) return;
    this.clear('timer');
    this.connect();
  }

  private connect(): void {
    const { url, open, emit } = this.options;
    emit({ type: 'state', state: { at: 'connecting' } });
    const full = this.lastId === null ? url : `${url}${url.includes('?') ? '&' : '?'}lastEventId=${encodeURIComponent(this.lastId)}`;
    const source = open(full);
    this.source = source;
    const on = (type: string, handle: (event: MessageEvent<string>) => void): void =>
      source.addEventListener(type, (event) => {
        if (this.source !== source) return;
        this.guardSilence();
        handle(event);
      });
    on('hello', (event) => this.hello(JSON.parse(event.data) as Hello));
    on('frame', (event) => {
      if (event.lastEventId) this.lastId = event.lastEventId;
      emit({ type: 'frame', frame: parseFrame(event.data) });
    });
    on('mark', (event) => emit({ type: 'mark', mark: JSON.parse(event.data) as Mark }));
    on('gap', (event) => emit({ type: 'gap', gap: JSON.parse(event.data) as Gap }));
    on('ping', (event) => emit({ type: 'ping', head: (JSON.parse(event.data) as { head: number }).head }));
    on('end', (event) => this.end((JSON.parse(event.data) as { state: RunState }).state));
    on('bye', () => this.lost());
    on('busy', () => this.wait('busy', busyMs + backoff(++this.tries, this.random())));
    source.addEventListener('error', () => {
      if (this.source === source) this.lost();
    });
    this.guardSilence();
  }

  private hello(hello: Hello): void {
    this.tries = 0;
    this.options.emit({ type: 'state', state: { at: 'open' } });
    this.options.emit({ type: 'hello', hello });
  }

  private end(run: RunState | null): void {
    this.drop();
    this.options.emit({ type: 'state', state: { at: 'ended', run } });
  }

  /** The connection broke. Whether it is worth another try is asked first: a run that ended answers 204 for ever. */
  private lost(): void {
    this.drop();
    this.wait('waiting', backoff(++this.tries, this.random()));
    this.options.probe().then((answer) => {
      if (this.closed || this.timer === null) return;
      if (answer === 'gone') {
        this.clear('timer');
        this.options.emit({ type: 'state', state: { at: 'gone' } });
      } else if (answer === 'finished' || answer === 'stopped' || answer === 'failed' || answer === 'interrupted') {
        this.clear('timer');
        this.end(answer);
      }
    });
  }

  private wait(at: 'waiting' | 'busy', ms: number): void {
    this.drop();
    this.clear('timer');
    const now = (this.options.now ?? Date.now)();
    this.options.emit({ type: 'state', state: { at, retryAt: now + ms, tries: this.tries } });
    this.timer = this.later(() => {
      this.timer = null;
      if (!this.closed) this.connect();
    }, ms);
  }

  private guardSilence(): void {
    this.clear('watchdog');
    this.watchdog = this.later(() => this.lost(), silenceMs);
  }

  private drop(): void {
    this.source?.close();
    this.source = null;
    this.clear('watchdog');
  }

  private later(callback: () => void, ms: number): unknown {
    return (this.options.later ?? setTimeout)(callback, ms);
  }

  private clear(which: 'timer' | 'watchdog'): void {
    if (this[which] !== null) (this.options.cancel ?? ((handle) => clearTimeout(handle as number)))(this[which]);
    this[which] = null;
  }

  private random(): number {
    return (this.options.random ?? Math.random)();
  }
}
