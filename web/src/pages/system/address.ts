/// The address bar keeps what is described, so that a reload, or the way back from a run, finds it again.
import { linkOf, longestLink } from '../../form/share_link';

/** ms without a change */
const pause = 300;

export class Address {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private turn = 0;

  /** A moment after the last change. */
  keep(document: Parameters<typeof linkOf>[1]): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.write(document), pause);
  }

  /** At once: before the page is left. */
  async write(document: Parameters<typeof linkOf>[1]): Promise<void> {
    clearTimeout(this.timer);
    const mine = ++this.turn;
    const link = await linkOf('/system', document);
    if (mine === this.turn) put(link.length > longestLink ? '' : new URL(link).hash);
  }

  /** What is described has an address of its own again. */
  clear(): void {
    this.stop();
    put('');
  }

  /** The page is left: nothing may be written behind it. */
  stop(): void {
    clearTimeout(this.timer);
    this.turn += 1;
  }
}

function put(hash: string): void {
  if (location.hash !== hash) history.replaceState(history.state, '', location.pathname + location.search + hash);
}
