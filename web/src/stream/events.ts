/// What the stream says, and what its client says about the stream itself.
import type { Mark, RunState } from '../api/types';

export interface Hello {
  epoch: string;
  run: string;
  topic: string;
  resumed: boolean;
  /** The tick after which frames follow. */
  from: number;
  head: number;
  dt: number;
  /** Signal ids in the order of every frame's values. */
  signals: number[];
}

export interface Frame {
  k: number;
  t: number;
  /** Ticks that this frame stands for. */
  n: number;
  /** NaN where the server sent null. */
  v: Float64Array;
}

export interface Gap {
  from: number;
  to: number;
  reason: string;
  fill: string;
}

/** waiting: for the next try, at `retryAt` (ms since the epoch). ended: the run makes no more frames. gone: there is no such run. */
export type StreamState =
  | { at: 'connecting' }
  | { at: 'open' }
  | { at: 'waiting'; retryAt: number; tries: number }
  | { at: 'busy'; retryAt: number; tries: number }
  | { at: 'ended'; run: RunState | null }
  | { at: 'gone' };

export type StreamEvent =
  | { type: 'state'; state: StreamState }
  | { type: 'hello'; hello: Hello }
  | { type: 'frame'; frame: Frame }
  | { type: 'mark'; mark: Mark }
  | { type: 'gap'; gap: Gap }
  | { type: 'ping'; head: number };

export function parseFrame(text: string): Frame {
  const raw = JSON.parse(text) as { k: number; t: number; n?: number; v: (number | null)[] };
  const v = new Float64Array(raw.v.length);
  for (let i = 0; i < v.length; i++) v[i] = raw.v[i] ?? NaN;
  return { k: raw.k, t: raw.t, n: raw.n ?? 1, v };
}
