import { base } from '../../api/client';
import type { CampaignProgress, CampaignState } from '../../api/campaigns';

/** What the feed says of a campaign, about once a second while it runs and whenever its state changes. */
export interface CampaignNote extends Partial<CampaignProgress> {
  id: string;
  state: CampaignState | 'deleted';
}

/**
 * Listens to the server's global feed. `connected` is told when the feed is lost and found again. A tab that nobody looks at
 * gives its connection up. Returns what stops it.
 */
export function watchCampaigns(happened: (note: CampaignNote) => void, connected: (is: boolean) => void): () => void {
  let source: EventSource | undefined;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let wait = 1000;
  let stopped = false;

  const heard = (event: Event): void => {
    try {
      const note = JSON.parse((event as MessageEvent<string>).data) as CampaignNote;
      if (typeof note.id === 'string') happened(note);
    } catch {
      return;
    }
  };
  const open = (): void => {
    source = new EventSource(`${base}/stream`);
    source.addEventListener('open', () => {
      wait = 1000;
      connected(true);
    });
    source.addEventListener('campaign', heard);
    source.addEventListener('error', () => {
      connected(false);
      if (source?.readyState !== EventSource.CLOSED || stopped) return;
      timer = setTimeout(open, wait);
      wait = Math.min(30_000, wait * 2);
    });
  };
  const close = (): void => {
    clearTimeout(timer);
    source?.close();
    source = undefined;
  };
  const visibility = (): void => {
    if (document.hidden) close();
    else if (!source) open();
  };
  document.addEventListener('visibilitychange', visibility);
  visibility();
  return () => {
    stopped = true;
    document.removeEventListener('visibilitychange', visibility);
    close();
  };
}

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
