/// The shared worker: one set of connections for all tabs of this origin, since a browser allows six of them.
import type { StreamEvent } from './events';
import { Streams } from './streams';

export type ToWorker = { do: 'listen'; id: number; run: string; topic: string } | { do: 'stop'; id: number } | { do: 'alive' } | { do: 'retry' } | { do: 'leave' };
export interface FromWorker {
  id: number;
  event: StreamEvent;
}

/** A tab that has not been heard for this long is gone (hidden tabs may run their timers once a minute). */
const forgetMs = 180_000;
const streams = new Streams();

interface Tab {
  stops: Map<number, () => void>;
  heard: number;
}
const tabs = new Map<MessagePort, Tab>();

function forget(port: MessagePort): void {
  for (const stop of tabs.get(port)?.stops.values() ?? []) stop();
  tabs.delete(port);
}

function receive(port: MessagePort, message: ToWorker): void {
  const tab = tabs.get(port);
  if (!tab) return;
  tab.heard = Date.now();
  if (message.do === 'listen') {
    const { id } = message;
    tab.stops.set(id, streams.listen(message.run, message.topic, (event) => port.postMessage({ id, event } satisfies FromWorker)));
  } else if (message.do === 'stop') {
    tab.stops.get(message.id)?.();
    tab.stops.delete(message.id);
  } else if (message.do === 'retry') {
    streams.retryNow();
  } else if (message.do === 'leave') {
    forget(port);
  }
}

addEventListener('connect', (event) => {
  const port = (event as MessageEvent).ports[0];
  if (!port) return;
  tabs.set(port, { stops: new Map(), heard: Date.now() });
  port.onmessage = (message: MessageEvent<ToWorker>) => receive(port, message.data);
  port.start();
});

setInterval(() => {
  for (const [port, tab] of tabs) if (Date.now() - tab.heard > forgetMs) forget(port);
}, 30_000);
