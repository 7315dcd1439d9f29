/// Changes of a linear system: whatever else has the size that changes, changes with it; what was there stays, the rest is zero.
import { isObject, type Json, type JsonObject } from '../../../form/json';
import { at, put } from '../../../form/pointer';
import { resized, type Cells } from '../draft';
import { withNames } from './names';
import { grown, squareOf, withController } from './open';
import { cellsAt, most, mostNodes, nodesOf, outputsOf, places, sensorPath, sizesOf, vectorAt, type Path } from './places';

const within = (value: number, least: number, largest = most): number => Math.min(largest, Math.max(least, value));

function fit(document: JsonObject, path: Path, rows: number, columns: number): JsonObject {
  return at(document, path) === undefined ? document : put(document, path, resized(cellsAt(document, path), rows, columns));
}

export function setStates(document: JsonObject, count: number): JsonObject {
  const n = within(count, 1);
  const { m } = sizesOf(document);
  let next = put(document, places.A, resized(cellsAt(document, places.A), n, n));
  next = m > 0 ? fit(next, places.B, n, m) : next;
  for (const id of nodesOf(next)) next = fit(next, [...sensorPath(id), 'C'], outputsOf(next, id), n);
  for (const path of [places.Q, places.P0, places.Mw]) next = fit(next, path, n, n);
  const x = vectorAt(next, places.truth);
  next = put(next, places.truth, Array.from({ length: n }, (_, i) => x[i] ?? 0));
  const estimates = at(next, ['initial', 'estimates']);
  if (isObject(estimates)) for (const [id, start] of Object.entries(estimates)) if (Array.isArray(start)) next = put(next, ['initial', 'estimates', id], Array.from({ length: n }, (_, i) => start[i] ?? 0));
  return withNames(withController(next));
}

export function setInputs(document: JsonObject, count: number): JsonObject {
  const m = within(count, 0);
  if (m === 0) return withNames(put(put(document, places.B, undefined), ['controller'], { type: 'none' }));
  return withNames(withController(put(document, places.B, resized(cellsAt(document, places.B), sizesOf(document).n, m))));
}

export function setOutputs(document: JsonObject, id: string, count: number): JsonObject {
  const p = within(count, 1);
  const path = sensorPath(id);
  let next = fit(document, [...path, 'C'], p, sizesOf(document).n);
  next = put(next, [...path, 'R'], grown(cellsAt(next, [...path, 'R']), p));
  return withNames(fit(next, [...path, 'Mv'], p, p));
}

/** A matrix as typed or pasted; where it is larger than the system, the system grows with it. */
export function setTable(document: JsonObject, path: Path, cells: Cells): JsonObject {
  const name = path.at(-1)!;
  const rows = within(cells.length, 1);
  const columns = within(Math.max(0, ...cells.map((row) => row.length)), 1);
  const square = Math.max(rows, columns);
  const keep = (next: JsonObject): JsonObject => put(next, path, resized(cells, cellsAt(next, path).length, cellsAt(next, path)[0]?.length ?? 0));
  const id = path[0] === 'nodes' ? path[1]! : '';
  if (name === 'C') return keep(setStates(setOutputs(document, id, rows), columns));
  if (name === 'R' || name === 'Mv') return keep(setOutputs(document, id, square));
  if (name === 'B') return keep(setStates(setInputs(document, columns), rows));
  if (name === 'Rc') return keep(setInputs(document, square));
  if (name === 'K') return keep(setStates(setInputs(document, rows), columns));
  return keep(setStates(document, square));
}

export function setNumber(document: JsonObject, path: Path, value: Json | undefined): JsonObject {
  return put(document, path, value ?? '');
}

export function addNode(document: JsonObject): JsonObject {
  const ids = nodesOf(document);
  if (ids.length >= mostNodes) return document;
  let number = ids.length + 1;
  while (ids.includes(String(number))) number += 1;
  return put(document, ['nodes', String(number)], { sensor: { type: 'linear', params: { C: resized([], 1, sizesOf(document).n), R: [[1]] } } });
}

/** Without a node, and without the edges that led to it. */
export function removeNode(document: JsonObject, id: string): JsonObject {
  const without = put(document, ['nodes', id], undefined);
  const bare = isObject(at(document, ['initial', 'estimates'])) ? put(without, ['initial', 'estimates', id], undefined) : without;
  const edges = at(bare, ['network', 'edges']);
  return Array.isArray(edges) ? put(bare, ['network', 'edges'], edges.filter((edge) => Array.isArray(edge) && !edge.map(String).includes(id))) : bare;
}

/** Bounded noise beside the random one, of the plant and of every sensor; off: none of it. */
export function setBounded(document: JsonObject, on: boolean): JsonObject {
  let next = put(document, places.Mw, on ? squareOf(0.01, sizesOf(document).n) : undefined);
  for (const id of nodesOf(next)) next = put(next, [...sensorPath(id), 'Mv'], on ? squareOf(0.01, outputsOf(next, id)) : undefined);
  return next;
}

export function setController(document: JsonObject, type: string): JsonObject {
  const { n, m } = sizesOf(document);
  if (type === 'none') return put(document, ['controller'], { type });
  const params: JsonObject = type === 'lqg' ? { Qc: squareOf(1, n), Rc: squareOf(1, m) } : type === 'feedback' ? { K: resized([], m, n) } : {};
  return put(document, ['controller'], { type, params });
}
