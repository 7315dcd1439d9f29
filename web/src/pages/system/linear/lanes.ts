/// Lanes of a description: by their methods, and those that attacks spare.
import { isObject, type JsonObject } from '../../../form/json';
import { freeId } from '../../../form/model';
import { put } from '../../../form/pointer';
import { objectAt } from './places';

export function lanesOf(document: JsonObject, method: string): string[] {
  return Object.entries(objectAt(document, ['lanes'])).flatMap(([id, lane]) => (isObject(lane) && lane.method === method ? [id] : []));
}

/** A lane of a method: the first one bears its name. `clean`: no attack reaches it. */
export function addLaneOf(document: JsonObject, method: string, clean = false): JsonObject {
  const id = freeId(objectAt(document, ['lanes']), clean ? `${method.slice(0, 22)}_clean` : method);
  return put(document, ['lanes', id], { method, ...(clean ? { adversary: false } : {}) });
}

export function removeLanesOf(document: JsonObject, method: string): JsonObject {
  const gone = lanesOf(document, method);
  return put(document, ['lanes'], Object.fromEntries(Object.entries(objectAt(document, ['lanes'])).filter(([id]) => !gone.includes(id))));
}
