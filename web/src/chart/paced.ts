/** Calls `act` at most once every `ms`. A call in between is not dropped: the last one acts when the time has passed. */
export function paced(ms: number, act: () => void, now: () => number = () => performance.now()): { call: (atOnce?: boolean) => void; stop: () => void } {
  let last = -Infinity;
  let pending: ReturnType<typeof setTimeout> | null = null;
  function stop(): void {
    if (pending !== null) clearTimeout(pending);
    pending = null;
  }
  function call(atOnce = false): void {
    const wait = last + ms - now();
    if (wait > 0 && !atOnce) {
      pending ??= setTimeout(call, wait, true);
      return;
    }
    stop();
    last = now();
    act();
  }
  return { call, stop };
}
