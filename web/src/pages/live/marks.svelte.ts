/// The marks of a run, in order of their ticks: those of the log and those that come in.
import { api } from '../../api/client';
import type { Mark } from '../../api/types';
import { activeAttacks, mergeMarks } from './mark_order';

const batchMs = 200;

export class MarkList {
  all = $state.raw<Mark[]>([]);
  active = $derived(activeAttacks(this.all));
  private waiting: Mark[] = [];
  private timer: ReturnType<typeof setTimeout> | null = null;

  async load(run: string): Promise<void> {
    try {
      this.all = mergeMarks(this.all, (await api.marks(run)).items);
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
