/// A document of a linear system made whole, so that every table of the form has its cells; the rest of it stays as it is.
import { isObject, type Json, type JsonObject } from '../../../form/json';
import { at, put } from '../../../form/pointer';
import { resized, type Cells } from '../draft';
import { cellsAt, controllerShapes, nodesOf, objectAt, places, sensorPath, sizesOf, vectorAt } from './places';

/** A covariance as a table: a number stands for as much of every component, a list for the diagonal. */
export function squareOf(value: Json | undefined, size: number, otherwise = 0): Cells {
  if (Array.isArray(value) && value.some((row) => Array.isArray(row))) return resized(value.map((row) => (Array.isArray(row) ? row : [])), size, size);
  return Array.from({ length: size }, (_, i) => Array.from({ length: size }, (__, j) => (i !== j ? 0 : Array.isArray(value) ? (value[i] ?? 0) : (value ?? otherwise))));
}

/** A covariance or weight with more components: the new ones get as much as the last one, so that none becomes certain or free. */
export function grown(cells: Cells, size: number): Cells {
  const last = cells.at(-1)?.at(-1) ?? 1;
  return resized(cells, size, size).map((row, i) => row.map((cell, j) => (i === j && i >= cells.length ? last : cell)));
}

/** A matrix as a document may have it: rows, a diagonal, a number. */
function matrixOf(value: Json | undefined): Cells {
  if (typeof value === 'number') return [[value]];
  if (Array.isArray(value) && value.some((row) => !Array.isArray(row))) return squareOf(value, value.length);
  return Array.isArray(value) ? value.map((row) => (Array.isArray(row) ? row : [])) : [];
}

const isNothing = (cells: Cells): boolean => cells.every((row) => row.every((cell) => cell === 0));

function withSensor(document: JsonObject, id: string, n: number): JsonObject {
  const path = sensorPath(id);
  const C = matrixOf(at(document, [...path, 'C']));
  const p = Math.max(1, C.length);
  const Mv = squareOf(at(document, [...path, 'Mv']), p);
  const params: JsonObject = { ...objectAt(document, path), C: resized(C, p, n), R: squareOf(at(document, [...path, 'R']), p, 1), Mv };
  if (isNothing(Mv)) delete params.Mv;
  return put(document, path, params);
}

function withNoise(document: JsonObject, n: number): JsonObject {
  const Mw = squareOf(at(document, places.Mw), n);
  let whole = put(document, places.Q, squareOf(at(document, places.Q), n));
  whole = put(whole, places.P0, squareOf(at(document, places.P0), n));
  return put(whole, places.Mw, isNothing(Mw) ? undefined : Mw);
}

/** The weights, gains and references of a controller, as large as the plant. */
export function withController(document: JsonObject): JsonObject {
  const sizes = sizesOf(document);
  const params = { ...objectAt(document, places.controller) };
  for (const [name, [rows, columns]] of Object.entries(controllerShapes)) {
    const given = params[name];
    if (given === undefined) continue;
    const cells = cellsAt(document, [...places.controller, name]);
    if (rows !== columns) params[name] = resized(cells, sizes[rows], sizes[columns]);
    else params[name] = cells.some((row) => row.length) ? grown(cells, sizes[rows]) : squareOf(given, sizes[rows]);
  }
  for (const [name, size] of [['x_ref', sizes.n], ['u_ref', sizes.m]] as const) {
    const given = params[name];
    if (Array.isArray(given)) params[name] = Array.from({ length: size }, (_, i) => given[i] ?? 0);
  }
  return Object.keys(params).length ? put(document, places.controller, params) : document;
}

/** Null: the document describes another kind of plant, or sensors that have no matrices. */
export function opened(document: JsonObject): JsonObject | null {
  if (at(document, ['plant', 'type']) !== 'linear' || nodesOf(document).some((id) => at(document, ['nodes', id, 'sensor', 'type']) !== 'linear')) return null;
  const A = matrixOf(at(document, places.A));
  const n = Math.max(1, A.length, ...A.map((row) => row.length));
  const B = matrixOf(at(document, places.B));
  const m = Math.max(0, ...B.map((row) => row.length));
  let whole = put(put(document, places.A, resized(A, n, n)), places.B, m > 0 ? resized(B, n, m) : undefined);
  for (const id of nodesOf(whole)) whole = withSensor(whole, id, n);
  whole = withController(withNoise(whole, n));
  const x = vectorAt(whole, places.truth);
  whole = put(whole, places.truth, Array.from({ length: n }, (_, i) => x[i] ?? 0));
  return isObject(whole.lanes) ? whole : put(whole, ['lanes'], {});
}
