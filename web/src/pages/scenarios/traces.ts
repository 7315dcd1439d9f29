import { get, post, postCsv } from '../../api/client';
import type { Page } from '../../api/types';
import type { JsonObject } from '../../form/json';

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

/** Stores any table, its columns mapped to signals by the server. */
export function storeMapped(name: string, csv: string, mapping: JsonObject): Promise<TraceItem> {
  return post<TraceItem>('/traces/map', { name, csv, mapping });
}

export interface BroughtLane {
  lane: string;
  /** Nodes at which every component of the state is there, and those at which some are. */
  whole: string[];
  part: string[];
}

/**
 * Lanes computed elsewhere that columns bring: `lane.<name>.<node>.estimate.<component>`. With a scenario its own lanes are
 * none of them, and a node counts as whole only where every component is there.
 */
export function lanesIn(columns: readonly string[], scenario?: { columns: readonly string[]; lanes: readonly string[] }): BroughtLane[] {
  const needed = scenario?.columns.filter((name) => name.startsWith('truth.')).map((name) => name.slice('truth.'.length)) ?? [];
  const found = new Map<string, Map<string, Set<string>>>();
  for (const column of columns) {
    const [, lane, node, component] = /^lane\.([^.]+)\.([^.]+)\.estimate\.(.+)$/.exec(column) ?? [];
    if (lane === undefined || scenario?.lanes.includes(lane)) continue;
    const nodes = found.get(lane) ?? found.set(lane, new Map()).get(lane)!;
    (nodes.get(node!) ?? nodes.set(node!, new Set()).get(node!)!).add(component!);
  }
  return [...found].map(([lane, nodes]) => {
    const whole = [...nodes].filter(([, components]) => needed.every((name) => components.has(name))).map(([node]) => node);
    return { lane, whole, part: [...nodes.keys()].filter((node) => !whole.includes(node)) };
  });
}
