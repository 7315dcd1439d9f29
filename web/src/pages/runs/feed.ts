import { watchFeed } from '../../api/feed';
import type { RunState } from '../../api/types';

/** What the feed says of a run, about once a second and whenever its state changes. */
export interface RunNote {
  id: string;
  state: RunState | 'deleted';
  k?: number;
  t?: number;
  ticks_per_second?: number | null;
}

export const watchRuns = (happened: (note: RunNote) => void, connected: (is: boolean) => void): (() => void) => watchFeed('run', happened, connected);
