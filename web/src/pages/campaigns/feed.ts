import type { CampaignProgress, CampaignState } from '../../api/campaigns';
import { watchFeed } from '../../api/feed';

/** What the feed says of a campaign, about once a second while it runs and whenever its state changes. */
export interface CampaignNote extends Partial<CampaignProgress> {
  id: string;
  state: CampaignState | 'deleted';
}

export const watchCampaigns = (happened: (note: CampaignNote) => void, connected: (is: boolean) => void): (() => void) => watchFeed('campaign', happened, connected);

/** An item with what the feed said of it. */
export function noted<T extends { state: CampaignState; progress: CampaignProgress }>(item: T, note: CampaignNote): T {
  if (note.state === 'deleted') return item;
  const { done, trials, failed, trials_per_second = null, seconds_left = null } = note;
  const running = note.state === 'running';
  return {
    ...item,
    state: note.state,
    progress: {
      done: done ?? item.progress.done,
      trials: trials ?? item.progress.trials,
      failed: failed ?? item.progress.failed,
      trials_per_second: running ? trials_per_second : null,
      seconds_left: running ? seconds_left : null,
    },
  };
}
