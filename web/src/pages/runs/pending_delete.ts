/// Deleting with second thoughts: runs vanish from the list at once, and from the server when the time for undoing is over.

export const undoMilliseconds = 10_000;

export interface PendingDelete {
  /** Runs that wait for their deletion. */
  readonly ids: ReadonlySet<string>;
  add(ids: readonly string[]): void;
  /** Takes all back that still wait. */
  undo(): void;
  /** Deletes at once what still waits, e.g. as the page is left. */
  flush(): void;
}

/**
 * `erase` deletes one run on the server and must not throw; `changed` is told whenever the set changes. Adding more runs starts
 * the time anew for all of them, so that one undo covers what one sees as one deed.
 */
export function pendingDelete(erase: (id: string) => void, changed: () => void, delay = undoMilliseconds): PendingDelete {
  const ids = new Set<string>();
  let timer: ReturnType<typeof setTimeout> | undefined;
  const settle = (): void => {
    clearTimeout(timer);
    const due = [...ids];
    ids.clear();
    for (const id of due) erase(id);
    if (due.length > 0) changed();
  };
  return {
    ids,
    add(more) {
      for (const id of more) ids.add(id);
      clearTimeout(timer);
      timer = setTimeout(settle, delay);
      changed();
    },
    undo() {
      clearTimeout(timer);
      ids.clear();
      changed();
    },
    flush: settle,
  };
}
