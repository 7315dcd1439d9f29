import { base } from '../../api/client';

/**
 * Listens to the server's global feed and tells which run something happened to. `connected` is told when the feed is lost and
 * found again. A tab that nobody looks at gives its connection up: a browser has six for all of them. Returns what stops it.
 */
export function watchRuns(happened: (run: string) => void, connected: (is: boolean) => void): () => void {
  let source: EventSource | undefined;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let wait = 1000;
  let stopped = false;

  const heard = (event: MessageEvent<string>): void => {
    try {
      const data = JSON.parse(event.data) as { run?: unknown; id?: unknown; type?: unknown };
      const run = data.run ?? data.id;
      if (typeof run === 'string' || typeof run === 'number') happened(String(run));
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
    for (const name of ['run', 'state', 'mark']) source.addEventListener(name, heard as (event: Event) => void);
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
