/// All streams of one browser (in the shared worker) or of one tab (without it): equal wishes share a connection.
import type { RunState } from '../api/types';
import { StreamClient, type Probe, type SourceLike } from './client';
import type { Hello, StreamEvent, StreamState } from './events';

type Listener = (event: StreamEvent) => void;

interface Shared {
  client: StreamClient;
  listeners: Set<Listener>;
  hello: Hello | null;
  state: StreamState | null;
}

export function streamUrl(run: string, topic: string): string {
  return `/api/v1/runs/${encodeURIComponent(run)}/stream?topic=${encodeURIComponent(topic)}`;
}

export function probeRun(run: string): Probe {
  return async () => {
    try {
      const response = await fetch(`/api/v1/runs/${encodeURIComponent(run)}`, { credentials: 'same-origin' });
      if (response.status === 404) return 'gone';
      if (!response.ok) return 'unknown';
      return ((await response.json()) as { state: RunState }).state;
    } catch {
      return 'unknown';
    }
  };
}

export class Streams {
  private readonly shared = new Map<string, Shared>();

  constructor(private readonly open: (url: string) => SourceLike = (url) => new EventSource(url, { withCredentials: true }) as unknown as SourceLike) {}

  /** Listens to a topic of a run. One who comes later is first told how the stream stands. Returns what stops it. */
  listen(run: string, topic: string, listener: Listener): () => void {
    const url = streamUrl(run, topic);
    const stream = this.shared.get(url) ?? this.start(url, run);
    if (stream.state) listener({ type: 'state', state: stream.state });
    if (stream.hello) listener({ type: 'hello', hello: { ...stream.hello, resumed: false, from: stream.hello.head } });
    stream.listeners.add(listener);
    return () => {
      stream.listeners.delete(listener);
      if (stream.listeners.size > 0 || this.shared.get(url) !== stream) return;
      stream.client.close();
      this.shared.delete(url);
    };
  }

  retryNow(): void {
    for (const stream of this.shared.values()) stream.client.retryNow();
  }

  private start(url: string, run: string): Shared {
    const listeners = new Set<Listener>();
    const stream: Partial<Shared> = { listeners, hello: null, state: null };
    const emit = (event: StreamEvent): void => {
      if (event.type === 'hello') stream.hello = event.hello;
      if (event.type === 'frame' && stream.hello) stream.hello.head = event.frame.k;
      if (event.type === 'state') stream.state = event.state;
      for (const listener of listeners) listener(event);
    };
    stream.client = new StreamClient({ url, open: this.open, probe: probeRun(run), emit });
    this.shared.set(url, stream as Shared);
    return stream as Shared;
  }
}
