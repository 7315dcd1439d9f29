/// Gains that are found before a run: what the server says of each problem, and asking until it has its answer.
import { get, post } from './client';

export type DesignState = 'queued' | 'solving' | 'done' | 'refused';

export interface DesignItem {
  lane: string;
  key: string;
  state: DesignState;
  /** Spent so far, and allowed at most. */
  seconds: number | null;
  limit: number | null;
  reason?: string | null;
  record: Record<string, unknown> | null;
}

export interface DesignRequest {
  scenario: string | Record<string, unknown>;
  patch?: Record<string, unknown>;
}

export const pollMs = 500;

export const designs = {
  /** Asks for the gains of every lane that needs some: the same problem again is the same answer. */
  ask: async (request: DesignRequest): Promise<DesignItem[]> => (await post<{ items: DesignItem[] }>('/designs', request)).items,
  of: (key: string, signal?: AbortSignal) => get<DesignItem>(`/designs/${encodeURIComponent(key)}`, {}, signal),
};

export const settled = ({ state }: DesignItem): boolean => state === 'done' || state === 'refused';

/** Why a design was refused; empty where it was not. */
export function refusalOf({ state, reason, record }: DesignItem): string {
  if (state !== 'refused') return '';
  const own = record && typeof record.reason === 'string' ? record.reason : '';
  return reason || own || '–';
}

/** Asks about twice a second until every problem has its answer, telling each time what is known. Throws ApiProblem. */
export async function follow(items: readonly DesignItem[], tell: (items: DesignItem[]) => void, signal: AbortSignal): Promise<void> {
  let known = [...items];
  while (!signal.aborted && !known.every(settled)) {
    await new Promise((resolve) => setTimeout(resolve, pollMs));
    if (signal.aborted) return;
    // Lanes may share a problem; the answer names one of them only.
    known = await Promise.all(known.map(async (item) => (settled(item) ? item : { ...(await designs.of(item.key, signal)), lane: item.lane })));
    if (!signal.aborted) tell(known);
  }
}
