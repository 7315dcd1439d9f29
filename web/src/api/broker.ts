/// The plant's broker, where the server has one.
import { get } from './client';

/** How a message says which tick it is of; docs/mqtt.md. */
export const clocks = ['k', 'time', 'arrival'] as const;
export type Clock = (typeof clocks)[number];

/** How a run is found in the broker's topics. */
export interface BrokerName {
  name: string;
  clock: Clock;
}

export interface Broker {
  url: string;
  connected: boolean;
  error: string | null;
  /** Patterns that feed runs. */
  topics?: string[];
}

/** Null: the server has none. */
export async function readBroker(signal: AbortSignal): Promise<Broker | null> {
  return (await get<{ broker: Broker | null }>('/ingest', {}, signal)).broker;
}
