/// Which lane meets which attack: docs/compatibility.md says what the words mean.
import { post } from './client';

export interface Cell {
  meets: 'estimate' | 'detector' | 'plant' | 'messages' | null;
  reason: string | null;
}

export interface Row {
  attack: string;
  title: { en: string; zh: string };
  channel: 'link' | 'sensor' | 'actuator';
  /** An example that is accepted there; null where there is none. */
  place: string | null;
  params: Record<string, unknown> | null;
  /** Why nobody meets it; null: the cells say who does. */
  reason: string | null;
  cells: Record<string, Cell>;
}

export interface Compatibility {
  lanes: { id: string; method: string }[];
  rows: Row[];
}

/** Of a document that need not be stored. */
export const askCompatibility = (scenario: unknown) => post<Compatibility>('/compatibility', { scenario });
