/// Who talks to whom: graphs by name as pairs, and pairs of one's own.
import type { JsonObject } from '../../../form/json';
import { at, put } from '../../../form/pointer';
import { nodesOf } from './places';

/** The graphs that the form draws; a document may name others, which stay as they are. */
export const graphs = ['none', 'path', 'ring', 'complete', 'centre', 'edges'] as const;

export type Pair = readonly [string, string];

export function graphOf(document: JsonObject): string {
  const name = at(document, ['network', 'graph']);
  return typeof name === 'string' ? name : 'none';
}

const same = ([a, b]: Pair, [c, d]: Pair): boolean => (a === c && b === d) || (a === d && b === c);

/** null: a graph that only the server can work out. */
export function pairsOf(document: JsonObject): Pair[] | null {
  const ids = nodesOf(document);
  const along = ids.slice(1).map((id, i): Pair => [ids[i]!, id]);
  switch (graphOf(document)) {
    case 'none':
    case 'centre':
      return [];
    case 'path':
      return along;
    case 'ring':
      return ids.length > 2 ? [...along, [ids.at(-1)!, ids[0]!]] : along;
    case 'complete':
      return ids.flatMap((id, i) => ids.slice(i + 1).map((other): Pair => [id, other]));
    case 'edges': {
      const edges = at(document, ['network', 'edges']);
      return Array.isArray(edges) ? edges.flatMap((edge): Pair[] => (Array.isArray(edge) && edge.length === 2 ? [[String(edge[0]), String(edge[1])]] : [])) : [];
    }
    default:
      return null;
  }
}

export const joined = (pairs: readonly Pair[], a: string, b: string): boolean => pairs.some((pair) => same(pair, [a, b]));

/** Another graph; pairs of one's own begin as those of the graph before. */
export function setGraph(document: JsonObject, graph: string): JsonObject {
  if (graph !== 'edges') return put(document, ['network'], { graph });
  return put(document, ['network'], { graph, edges: (pairsOf(document) ?? []).map(([a, b]) => [a, b]) });
}

/** Joins two nodes, or parts them: from then on the graph is one of its own pairs. */
export function toggle(document: JsonObject, a: string, b: string): JsonObject {
  const own = setGraph(document, 'edges');
  const pairs = pairsOf(own) ?? [];
  const next = joined(pairs, a, b) ? pairs.filter((pair) => !same(pair, [a, b])) : [...pairs, [a, b] as const];
  return put(own, ['network', 'edges'], next.map(([from, to]) => [from, to]));
}
