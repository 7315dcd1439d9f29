/// Single keys. They can be turned off, and none fires while somebody types or a dialog is open.
import { readPreference, writePreference } from '../theme/preferences';

let on = $state(readPreference('keys') !== 'off');

export const keys = {
  get on(): boolean {
    return on;
  },
  set(next: boolean): void {
    on = next;
    writePreference('keys', next ? 'on' : 'off');
  },
};

function typing(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  return target.isContentEditable || ['INPUT', 'TEXTAREA', 'SELECT'].includes(target.tagName);
}

/** Space on a button or a disclosure belongs to it. */
function ownsSpace(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest('button, summary, a[href]') !== null;
}

export type KeyHandlers = Record<string, (event: KeyboardEvent) => void>;

/**
 * Listens for keys by their `key` name, and for pairs like "g r" typed within a second. Returns what stops it.
 */
export function listen(handlers: KeyHandlers): () => void {
  let first: { key: string; at: number } | null = null;
  const onKey = (event: KeyboardEvent): void => {
    if (!on || event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    if (typing(event.target) || document.querySelector('dialog[open]')) return;
    if (event.key === ' ' && ownsSpace(event.target)) return;
    const pair = first && event.timeStamp - first.at < 1000 ? `${first.key} ${event.key}` : null;
    const handler = (pair && handlers[pair]) || handlers[event.key];
    first = { key: event.key, at: event.timeStamp };
    if (!handler) return;
    event.preventDefault();
    handler(event);
  };
  addEventListener('keydown', onKey);
  return () => removeEventListener('keydown', onKey);
}
