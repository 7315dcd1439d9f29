/// Items by source and verdict.
import type { PaperItem, Verdict } from '../../api/papers';

export type Kind = 'reproduced' | 'corrected' | 'not' | 'none';
export const kinds: readonly Kind[] = ['reproduced', 'corrected', 'not', 'none'];

const kindOfVerdict: Record<Verdict, Kind> = { reproduced: 'reproduced', 'reproduced after correction': 'corrected', 'not reproduced': 'not' };

export function kindOf({ verdict }: Pick<PaperItem, 'verdict'>): Kind {
  return verdict === null ? 'none' : kindOfVerdict[verdict];
}

export function readKind(text: string | null): Kind | null {
  return kinds.find((kind) => kind === text) ?? null;
}

/** With fewer runs a mean scatters so much that a verdict may differ. One run is of what has nothing random in it. */
export const leastRuns = 30;
export const isFew = (runs: number | null): boolean => runs !== null && runs > 1 && runs < leastRuns;

export const sourceOf = (key: string): string => key.split('/')[0]!;

export interface Source {
  source: string;
  items: PaperItem[];
}

/** Those of one kind, or all where it is null; sources that have none are left out. */
export function bySource(items: readonly PaperItem[], kind: Kind | null): Source[] {
  const sources: Source[] = [];
  for (const item of items) {
    if (kind !== null && kindOf(item) !== kind) continue;
    const source = sourceOf(item.key);
    if (sources.at(-1)?.source !== source) sources.push({ source, items: [] });
    sources.at(-1)!.items.push(item);
  }
  return sources;
}

export function countOf(items: readonly PaperItem[], kind: Kind): number {
  return items.filter((item) => kindOf(item) === kind).length;
}

export const neighbours = (items: readonly PaperItem[], key: string): { previous: PaperItem | null; next: PaperItem | null } => {
  const place = items.findIndex((item) => item.key === key);
  return { previous: (place > 0 && items[place - 1]) || null, next: (place >= 0 && items[place + 1]) || null };
};
