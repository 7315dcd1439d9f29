/// The page's door to the streams: the shared worker where the browser has one, else connections of this tab.
import type { StreamEvent } from './events';
import { Streams } from './streams';
import type { FromWorker, ToWorker } from './worker';

type Listener = (event: StreamEvent) => void;

interface Hub {
  listen(run: string, topic: string, listener: Listener): () => void;
  retryNow(): void;
}

class WorkerHub implements Hub {
  private readonly listeners = new Map<number, { run: string; topic: string; listener: Listener }>();
  private next = 1;
  private readonly port: MessagePort;

  constructor(worker: SharedWorker) {
    this.port = worker.port;
    this.port.onmessage = (message: MessageEvent<FromWorker>) => this.listeners.get(message.data.id)?.listener(message.data.event);
    this.port.start();
    setInterval(() => this.tell({ do: 'alive' }), 20_000);
    addEventListener('pagehide', () => this.tell({ do: 'leave' }));
    addEventListener('pageshow', (event) => {
      // A page taken back from the browser's cache: its port was forgotten, and a new one is easiest had by a reload.
      if (event.persisted) location.reload();
    });
  }

  listen(run: string, topic: string, listener: Listener): () => void {
    const id = this.next++;
    this.listeners.set(id, { run, topic, listener });
    this.tell({ do: 'listen', id, run, topic });
    return () => {
      this.listeners.delete(id);
      this.tell({ do: 'stop', id });
    };
  }

  retryNow(): void {
    this.tell({ do: 'retry' });
  }

  private tell(message: ToWorker): void {
    this.port.postMessage(message);
  }
}

function make(): Hub {
  if (typeof SharedWorker === 'function') {
    try {
      return new WorkerHub(new SharedWorker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'vigil-streams' }));
    } catch {
      return new Streams();
    }
  }
  return new Streams();
}

let hub: Hub | null = null;

/** Listens to a topic of a run: `overview`, `lane:<lane>` or `all`. Returns what stops it. */
export function listen(run: string, topic: string, listener: Listener): () => void {
  hub ??= make();
  return hub.listen(run, topic, listener);
}

/** Ends the wait of every stream that waits for its next try. */
export function retryNow(): void {
  hub?.retryNow();
}
