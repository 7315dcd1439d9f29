/// The methods' documentation: what docs/methods has, as data.
import { get } from './client';
import type { EquationItem, Words } from './papers';

export type MethodKind = 'method' | 'protection' | 'detector';

export interface MethodLine {
  id: string;
  kind: MethodKind;
  title: Words;
  family: string;
  line: string;
}

export interface MethodParameter {
  name: string;
  symbol: string;
  default: unknown;
  required: boolean;
  unit: string;
  accepts: string;
  live: boolean;
  meaning: Words;
}

export interface MethodCorrection {
  text: string;
  /** That selects the other reading; null: none does. */
  parameter: string | null;
  value?: unknown;
  /** Whether that reading is what the source prints. */
  printed?: boolean;
  usual?: boolean;
}

/** Texts are sentences in English with names and formulas between backticks. */
export interface MethodPage extends MethodLine {
  source: string;
  where: string;
  model: string;
  equations: EquationItem[];
  steps: string[];
  parameters: MethodParameter[];
  cost: string;
  corrected: MethodCorrection[];
}

export const documentation = {
  list: (signal?: AbortSignal) => get<{ items: MethodLine[] }>('/documentation', {}, signal),
  one: (id: string, signal?: AbortSignal) => get<MethodPage>(`/documentation/${encodeURIComponent(id)}`, {}, signal),
};
