import { get, postCsv } from '../../api/client';
import type { Page } from '../../api/types';

export interface TraceItem {
  id: string;
  name: string;
  rows: number;
  columns: string[];
  bytes: number;
  created: string;
}

export async function listTraces(signal?: AbortSignal): Promise<TraceItem[]> {
  return (await get<Page<TraceItem>>('/traces', {}, signal)).items;
}

/** Stores a CSV file; the same text again gives the trace it made before. */
export function uploadTrace(name: string, text: string): Promise<TraceItem> {
  return postCsv<TraceItem>('/traces', text, { name });
}
