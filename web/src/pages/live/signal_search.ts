import type { Signal } from '../../api/types';

/** Signals whose names hold every word asked for; those that begin with the first word come first. */
export function searchSignals(signals: readonly Signal[], asked: string, limit: number): Signal[] {
  const words = asked.toLowerCase().split(/\s+/).filter(Boolean);
  if (!words.length) return [];
  const found = signals.filter((signal) => words.every((word) => signal.name.toLowerCase().includes(word)));
  const begins = (signal: Signal): number => (signal.name.toLowerCase().startsWith(words[0]!) ? 0 : 1);
  return found.sort((a, b) => begins(a) - begins(b) || a.id - b.id).slice(0, limit);
}
