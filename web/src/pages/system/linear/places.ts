/// Where the parts of a linear system stand in its document, and what its sizes are.
import { isObject, type Json, type JsonObject } from '../../../form/json';
import { at, pointer } from '../../../form/pointer';
import type { Cells } from '../draft';

export type Path = readonly string[];

export const places = {
  A: ['plant', 'params', 'A'],
  B: ['plant', 'params', 'B'],
  Q: ['noise', 'Q'],
  P0: ['noise', 'P0'],
  Mw: ['noise', 'Mw'],
  truth: ['initial', 'truth'],
  controller: ['controller', 'params'],
} as const;

export const sensorPath = (id: string): string[] => ['nodes', id, 'sensor', 'params'];
export const pointerOf = (path: Path): string => pointer(path);

/** The most states, inputs and channels the engine takes, and the most nodes this form shows. */
export const most = 12;
export const mostNodes = 12;

export interface Sizes {
  /** States. */
  n: number;
  /** Inputs. */
  m: number;
}

export const objectAt = (document: JsonObject, path: Path): JsonObject => {
  const found = at(document, path);
  return isObject(found) ? found : {};
};

export function cellsAt(document: JsonObject, path: Path): Cells {
  const found = at(document, path);
  return Array.isArray(found) ? found.map((row) => (Array.isArray(row) ? row : [])) : [];
}

export function vectorAt(document: JsonObject, path: Path): Json[] {
  const found = at(document, path);
  return Array.isArray(found) ? found : [];
}

export function sizesOf(document: JsonObject): Sizes {
  return { n: cellsAt(document, places.A).length, m: cellsAt(document, places.B)[0]?.length ?? 0 };
}

export const nodesOf = (document: JsonObject): string[] => Object.keys(objectAt(document, ['nodes']));
export const outputsOf = (document: JsonObject, id: string): number => cellsAt(document, [...sensorPath(id), 'C']).length;

/** Matrices of the controllers, by the sizes that their rows and columns have. */
export const controllerShapes: Readonly<Record<string, readonly ['n' | 'm', 'n' | 'm']>> = { Qc: ['n', 'n'], Rc: ['m', 'm'], K: ['m', 'n'] };

/** Every matrix of the document that the form shows as a table, in its order. */
export function tablesOf(document: JsonObject): string[][] {
  const noise = [places.Q, places.P0, places.Mw].filter((path) => at(document, path) !== undefined);
  const sensors = nodesOf(document).flatMap((id) => ['C', 'R', 'Mv'].map((name) => [...sensorPath(id), name])).filter((path) => Array.isArray(at(document, path)));
  const controller = Object.keys(controllerShapes).map((name) => [...places.controller, name]).filter((path) => Array.isArray(at(document, path)));
  return [[...places.A], [...places.B], ...sensors, ...noise.map((path) => [...path]), ...controller].filter((path) => cellsAt(document, path).length > 0);
}
