/// The plant's broker, where the server has one.
import { get } from './client';

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
