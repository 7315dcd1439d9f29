/// How two runs belong together: one forked from the other, or both from a third.
import type { RunItem } from '../../../api/types';

type Forked = Pick<RunItem, 'id' | 'parent'>;

/** The tick up to which two runs are the same; null: they are no branches of each other. */
export function forkTick(run: Forked, other: Forked): number | null {
  if (run.id === other.id) return null;
  if (run.parent?.run === other.id) return run.parent.k;
  if (other.parent?.run === run.id) return other.parent.k;
  if (run.parent && other.parent && run.parent.run === other.parent.run) return Math.min(run.parent.k, other.parent.k);
  return null;
}
