import { base } from './client';

/**
 * Listens to one kind of event of the server's global feed and tells what happened to whom. `connected` is told when the feed
 * is lost and found again. A tab that nobody looks at gives its connection up: a browser has six for all of them. Returns what
 * stops it.
 */
export function watchFeed<Note extends { id: string }>(kind: 'run' | 'campaign', happened: (note: Note) => void, connected: (is: boolean) => void): () => void {
  let source: EventSource | undefined;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let wait = 1000;
  let stopped = false;

  const heard = (event: MessageEvent<string>): void => {
    try {
      const note = JSON.parse(event.data) as Note;
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
    source.addEventListener(kind, heard as (event: Event) => void);
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
