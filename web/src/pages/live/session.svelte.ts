/// One run on the screen: its description, its streams, its marks. Samples stay in the source, outside reactive state.
import { api } from '../../api/client';
import { ApiProblem } from '../../api/problem';
import { isLive, type Mark, type RunDetail, type RunState } from '../../api/types';
import { loop } from '../../chart/loop';
import { Ring } from '../../data/ring';
import { Source } from '../../data/source';
import type { Frame, Hello, StreamEvent, StreamState } from '../../stream/events';
import { listen } from '../../stream/hub';
import { makeModel, laneOf, type RunModel } from './model';
import { Hands } from './hands/hands.svelte';
import { MarkList } from './marks.svelte';
import type { LiveView } from './view.svelte';

const refreshMs = 2000;
const statusMs = 250;
const awaitMs = 400;
const maxGap = 12_000;
const fillAgainMs = 700;
const thinnedMs = 2000;
const mostFramesPerSecond = 60;

export interface Status {
  head: number;
  t: number;
  /** Frames a second, over the last second. */
  rate: number;
  gaps: number;
  drawMs: number;
  stale: boolean;
}

export class Session {
  run = $state.raw<RunDetail | null>(null);
  model = $state.raw<RunModel | null>(null);
  failure = $state.raw<unknown>(null);
  stream = $state.raw<StreamState>({ at: 'connecting' });
  status = $state.raw<Status>({ head: 0, t: 0, rate: 0, gaps: 0, drawMs: 0, stale: false });
  readonly marks = new MarkList();
  readonly hands = new Hands();
  source: Source | null = null;

  private overview: Ring | null = null;
  private lane: { id: string; ring: Ring | null; stop: () => void } | null = null;
  private stopOverview: (() => void) | null = null;
  private timers: ReturnType<typeof setInterval>[] = [];
  private arrivals: number[] = [];
  private gaps = 0;
  private t = 0;
  private closed = false;
  private readonly lacking = new Map<Ring, { from: number; to: number }>();

  constructor(
    readonly id: string,
    private readonly view: LiveView,
  ) {
    void this.load();
  }

  close(): void {
    this.closed = true;
    this.stopOverview?.();
    this.lane?.stop();
    this.source?.close();
    for (const timer of this.timers) clearInterval(timer);
  }

  async load(): Promise<void> {
    this.failure = null;
    try {
      const [run, signals] = await Promise.all([api.run(this.id), api.signals(this.id)]);
      if (this.closed) return;
      // A run that waits for its turn or is being made ready has no signals yet.
      if (signals.length === 0 && isLive(run.state)) {
        this.run = run;
        setTimeout(() => void (this.closed || this.load()), awaitMs);
        return;
      }
      this.source = new Source(this.id, signals, () => loop.data());
      this.model = makeModel(run, signals);
      this.take(run);
      void this.marks.load(this.id);
      if (!isLive(run.state)) this.stream = { at: 'ended', run: run.state };
      else this.stopOverview = listen(this.id, 'overview', (event) => this.receive(event, 'overview'));
      this.timers.push(setInterval(() => this.tick(), statusMs), setInterval(() => void this.refresh(), refreshMs));
      this.tick();
    } catch (error) {
      this.failure = error;
    }
  }

  get live(): boolean {
    return this.run !== null && isLive(this.run.state);
  }

  /** Takes the server's newest word on the run. */
  take(run: RunDetail): void {
    if (this.closed) return;
    this.run = run;
    const source = this.source;
    if (!source) return;
    source.growing = isLive(run.state);
    if (run.progress.k > source.head) {
      source.head = run.progress.k;
      this.t = run.progress.t;
    }
    source.touch();
  }

  async refresh(): Promise<void> {
    if (document.hidden || !this.live) return;
    try {
      this.take(await api.run(this.id));
    } catch (error) {
      if (error instanceof ApiProblem && error.status === 404) this.failure = error;
    }
  }

  /** Streams the lane whose details are looked at. The overview has the others' errors. */
  watchLane(id: string | null): void {
    if (!this.model || !this.live || this.lane?.id === id) return;
    this.lane?.stop();
    this.lane = null;
    const lane = laneOf(this.model, id);
    if (!lane) return;
    const watched = { id: lane.id, ring: null as Ring | null, stop: () => {} };
    this.lane = watched;
    this.arrange();
    watched.stop = listen(this.id, `lane:${lane.id}`, (event) => {
      if (this.lane === watched) this.receive(event, 'lane');
    });
  }

  private arrange(): void {
    if (this.source) this.source.rings = [this.overview, this.lane?.ring].filter((ring): ring is Ring => !!ring);
  }

  private receive(event: StreamEvent, which: 'overview' | 'lane'): void {
    if (this.closed) return;
    const source = this.source!;
    if (event.type === 'state' && which === 'overview') this.streamState(event.state);
    if (event.type === 'hello') this.hello(event.hello, which);
    const ring = which === 'overview' ? this.overview : this.lane?.ring;
    if (event.type === 'frame' && ring) {
      if (!ring.push(event.frame)) return;
      this.thinned(ring, event.frame);
      if (which !== 'overview') return;
      source.head = Math.max(source.head, event.frame.k);
      this.t = event.frame.t;
      this.arrivals.push(performance.now());
      source.touch();
    }
    if (event.type === 'gap' && ring) {
      if (which === 'overview') this.gaps++;
      void this.fill(ring, event.gap.from, event.gap.to);
    }
    if (event.type === 'mark' && which === 'overview') this.mark(event.mark);
  }

  private streamState(state: StreamState): void {
    this.stream = state;
    if (state.at === 'ended') void this.afterEnd();
    if (state.at === 'open') void this.refresh();
  }

  private async afterEnd(): Promise<void> {
    try {
      this.take(await api.run(this.id));
    } catch (error) {
      this.failure = error;
    }
  }

  private hello(hello: Hello, which: 'overview' | 'lane'): void {
    const known = which === 'overview' ? this.overview : this.lane?.ring;
    const same = known && known.signals.length === hello.signals.length && known.signals.every((id, i) => id === hello.signals[i]);
    const before = same ? known : null;
    const ring = before ?? new Ring(hello.signals);
    if (which === 'overview') this.overview = ring;
    else if (this.lane) this.lane.ring = ring;
    this.arrange();
    if (hello.resumed || hello.from < 0) return;
    // What was before the first frame, as far as the window reaches; or what a reconnect lost.
    const from = before && before.length ? before.last + 1 : Math.max(0, hello.from - Math.max(600, this.view.width));
    void this.fill(ring, from, hello.from);
  }

  /** Fetches what the ring lacks. The newest ticks reach the log a moment after the stream: asked again until they are there. */
  private async fill(ring: Ring, from: number, to: number, tries = 6): Promise<void> {
    if (this.closed || to < from || to - from > maxGap) return;
    let reached = from - 1;
    try {
      const rows = await this.source!.rows(ring, from, to);
      ring.insert(rows);
      reached = rows.at(-1)?.k ?? reached;
      this.source?.inserted();
    } catch {
      // The hatched gap stays for now: it is what is known.
      reached = from - 1;
    }
    if (reached < to && tries > 1) setTimeout(() => void this.fill(ring, reached + 1, to, tries - 1), fillAgainMs);
  }

  /** Ticks that a slow connection thinned out are fetched later, together. A run faster than any screen stays thinned. */
  private thinned(ring: Ring, frame: Frame): void {
    const pace = this.run?.pace;
    if (frame.n < 2 || typeof pace !== 'number' || pace > mostFramesPerSecond) return;
    const waiting = this.lacking.get(ring);
    const from = frame.k - frame.n + 1;
    if (waiting) {
      waiting.to = frame.k - 1;
      return;
    }
    const range = { from, to: frame.k - 1 };
    this.lacking.set(ring, range);
    setTimeout(() => {
      this.lacking.delete(ring);
      void this.fill(ring, range.from, range.to);
    }, thinnedMs);
  }

  private mark(mark: Mark): void {
    this.marks.add(mark);
    if (mark.type === 'state' && this.run && mark.code) this.take({ ...this.run, state: mark.code as RunState });
    if (mark.type === 'state' || mark.type === 'command') void this.refresh();
  }

  private tick(): void {
    const source = this.source;
    if (!source || !this.run) return;
    const now = performance.now();
    while (this.arrivals.length && now - this.arrivals[0]! > 1000) this.arrivals.shift();
    this.view.head = source.head;
    const every = typeof this.run.pace === 'number' ? 1000 / this.run.pace : 0;
    const last = this.arrivals.at(-1);
    if (last !== undefined) this.lastArrival = last;
    const silent = now - this.lastArrival > Math.max(2000, 2.5 * every);
    const stale = this.live && (this.stream.at !== 'open' || (this.run.state === 'running' && silent));
    const next: Status = { head: source.head, t: this.t, rate: this.arrivals.length, gaps: this.gaps, drawMs: loop.drawMs, stale };
    this.status = next;
  }
  private lastArrival = performance.now();
}
