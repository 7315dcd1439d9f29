import { describe, expect, it } from 'vitest';
import { backoff, StreamClient, type SourceLike } from './client';
import type { StreamEvent, StreamState } from './events';
import { parseFrame } from './events';

type Handler = (event: MessageEvent<string>) => void;

class FakeSource implements SourceLike {
  closed = false;
  private handlers = new Map<string, Handler[]>();
  constructor(readonly url: string) {}
  addEventListener(type: string, handler: Handler): void {
    this.handlers.set(type, [...(this.handlers.get(type) ?? []), handler]);
  }
  close(): void {
    this.closed = true;
  }
  send(type: string, data: unknown = {}, lastEventId = ''): void {
    for (const handler of this.handlers.get(type) ?? []) handler({ data: JSON.stringify(data), lastEventId } as MessageEvent<string>);
  }
}

function bench(answer: string = 'running') {
  const sources: FakeSource[] = [];
  const events: StreamEvent[] = [];
  const timers: { at: number; run: () => void; off: boolean }[] = [];
  let now = 1000;
  const client = new StreamClient({
    url: '/api/v1/runs/7/stream?topic=overview',
    open: (url) => {
      const source = new FakeSource(url);
      sources.push(source);
      return source;
    },
    probe: () => Promise.resolve(answer as 'running'),
    emit: (event) => events.push(event),
    now: () => now,
    random: () => 0,
    later: (run, ms) => {
      const timer = { at: now + ms, run, off: false };
      timers.push(timer);
      return timer;
    },
    cancel: (handle) => ((handle as { off: boolean }).off = true),
  });
  const pass = (ms: number): void => {
    now += ms;
    for (const timer of timers.filter((one) => one.at <= now && !one.off)) {
      timer.off = true;
      timer.run();
    }
  };
  const states = (): StreamState['at'][] => events.filter((event) => event.type === 'state').map((event) => event.state.at);
  return { client, sources, events, pass, states, hello: { epoch: 'e', run: '7', topic: 'overview', resumed: false, from: 5, head: 5, dt: 1, signals: [0, 1] } };
}

describe('the stream of a run', () => {
  it('gives frames with missing values as NaN', () => {
    const frame = parseFrame('{"k":5,"t":0.5,"n":2,"v":[1.5,null]}');
    expect(frame).toMatchObject({ k: 5, t: 0.5, n: 2 });
    expect([...frame.v]).toEqual([1.5, NaN]);
  });

  it('resumes after a break with the id of the last frame, not before its wait is over', async () => {
    const { sources, pass, hello, states } = bench();
    sources[0]!.send('hello', hello);
    sources[0]!.send('frame', { k: 5, t: 5, n: 1, v: [1, 2] }, 'e.5');
    sources[0]!.send('error');
    await Promise.resolve();
    expect(sources[0]!.closed).toBe(true);
    pass(999);
    expect(sources).toHaveLength(1);
    pass(1);
    expect(sources).toHaveLength(2);
    expect(sources[1]!.url).toBe('/api/v1/runs/7/stream?topic=overview&lastEventId=e.5');
    expect(states()).toEqual(['connecting', 'open', 'waiting', 'connecting']);
  });

  it('waits longer after each failure, and starts over once it was connected', async () => {
    const { sources, pass, events, hello } = bench();
    const waits: number[] = [];
    for (const ms of [1000, 2000, 4000]) {
      sources.at(-1)!.send('error');
      await Promise.resolve();
      const last = events.at(-1)!;
      if (last.type === 'state' && last.state.at === 'waiting') waits.push(last.state.tries);
      pass(ms);
    }
    expect(waits).toEqual([1, 2, 3]);
    expect(sources).toHaveLength(4);
    sources[3]!.send('hello', hello);
    sources[3]!.send('error');
    await Promise.resolve();
    pass(1000);
    expect(sources).toHaveLength(5);
  });

  it.each([
    [1, 1000],
    [2, 2000],
    [5, 16000],
    [6, 30000],
    [40, 30000],
  ])('try %i waits %i ms at most', (tries, ms) => {
    expect(backoff(tries, 0)).toBe(ms);
    expect(backoff(tries, 1)).toBe(ms * 0.75);
  });

  it('stops when the run has ended, although the connection only broke', async () => {
    const { sources, pass, states } = bench('interrupted');
    sources[0]!.send('error');
    await Promise.resolve();
    await Promise.resolve();
    pass(60_000);
    expect(sources).toHaveLength(1);
    expect(states().at(-1)).toBe('ended');
  });

  it('stops when there is no such run', async () => {
    const { sources, pass, states } = bench('gone');
    sources[0]!.send('error');
    await Promise.resolve();
    await Promise.resolve();
    pass(60_000);
    expect(sources).toHaveLength(1);
    expect(states().at(-1)).toBe('gone');
  });

  it('passes gaps and marks on, and closes at the end', () => {
    const { sources, events, hello, states } = bench();
    sources[0]!.send('hello', hello);
    sources[0]!.send('gap', { from: 6, to: 9, reason: 'slow', fill: '/api/v1/runs/7/samples?from=6&to=9' });
    sources[0]!.send('mark', { k: 7, type: 'alarm', edge: 'begin' });
    sources[0]!.send('end', { state: 'finished' });
    expect(events.find((event) => event.type === 'gap')).toMatchObject({ gap: { from: 6, to: 9 } });
    expect(events.find((event) => event.type === 'mark')).toMatchObject({ mark: { k: 7 } });
    expect(sources[0]!.closed).toBe(true);
    expect(states().at(-1)).toBe('ended');
  });

  it('opens anew after 25 s of silence', async () => {
    const { sources, pass, hello } = bench();
    sources[0]!.send('hello', hello);
    pass(24_000);
    sources[0]!.send('ping', { head: 9 });
    pass(24_000);
    expect(sources[0]!.closed).toBe(false);
    pass(1000);
    expect(sources[0]!.closed).toBe(true);
    await Promise.resolve();
    pass(1000);
    expect(sources).toHaveLength(2);
  });

  it('tells a full server from a broken one', () => {
    const { sources, states } = bench();
    sources[0]!.send('busy');
    expect(states().at(-1)).toBe('busy');
  });

  it('ignores what an abandoned connection still says', async () => {
    const { sources, pass, events, hello } = bench();
    sources[0]!.send('hello', hello);
    sources[0]!.send('error');
    await Promise.resolve();
    pass(1000);
    const count = events.length;
    sources[0]!.send('frame', { k: 6, t: 6, n: 1, v: [] }, 'e.6');
    expect(events).toHaveLength(count);
  });

  it('tries at once when asked to', async () => {
    const { client, sources } = bench();
    sources[0]!.send('error');
    await Promise.resolve();
    client.retryNow();
    expect(sources).toHaveLength(2);
    client.close();
    expect(sources[1]!.closed).toBe(true);
  });
});
