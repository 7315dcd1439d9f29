/// The marks of a run, in order of their ticks: those of the log and those that come in.
import { api } from '../../api/client';
import type { Mark } from '../../api/types';
import { activeAttacks, heldFrom, mergeMarks } from './mark_order';

const batchMs = 200;
/** Marks are read so many at a time, and so often: a restless detector makes thousands. */
const page = 10_000;
const mostPages = 5;

export class MarkList {
  all = $state.raw<Mark[]>([]);
  active = $derived(activeAttacks(this.all));
  /** The tick from which on no alarm is missing here. */
  held = $derived(heldFrom(this.all));
  private waiting: Mark[] = [];
  private timer: ReturnType<typeof setTimeout> | null = null;

  async load(run: string): Promise<void> {
    try {
      let cursor: string | undefined;
      for (let i = 0; i < mostPages; i++) {
        const { items, next } = await api.marks(run, { limit: page, cursor });
        this.all = mergeMarks(this.all, items);
        if (!next) break;
        cursor = next;
      }
    } catch {
      // The list stays as the stream gives it; the run's own problem is shown by the page.
      return;
    }
  }

  add(mark: Mark): void {
    this.waiting.push(mark);
    this.timer ??= setTimeout(() => {
      this.timer = null;
      this.all = mergeMarks(this.all, this.waiting.splice(0));
    }, batchMs);
  }
}
