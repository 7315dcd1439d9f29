/// When an attack by hand acts: its first and last tick, and bursts within them.
export interface AttackTimes {
  /** null: at once. */
  from: number | null;
  /** Last tick; null: until it is stopped. */
  to: number | null;
  /** Acts in the first `for` of every `every` ticks; null: all the time. */
  bursts: { every: number; for: number } | null;
  /** Ticks in all; null: no limit. */
  budget: number | null;
}

export const always: AttackTimes = { from: null, to: null, bursts: null, budget: null };

/** As the API takes them. */
export function sentTimes({ from, to, bursts, budget }: AttackTimes): { from?: number; to?: number; schedule?: Record<string, unknown> } {
  return {
    ...(from === null ? {} : { from }),
    ...(to === null ? {} : { to }),
    ...(bursts || budget !== null ? { schedule: { ...(bursts ?? {}), ...(budget === null ? {} : { budget }) } } : {}),
  };
}
