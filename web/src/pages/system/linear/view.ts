/// What the live page is told to draw of a linear system: its first two states against each other, and the errors of its states.
import { equal, isObject, type JsonObject } from '../../../form/json';
import { at, put } from '../../../form/pointer';
import { stateNames } from './names';
import { objectAt } from './places';

/** More curves than these say less. */
const mostErrors = 6;

export function viewOf(document: JsonObject): JsonObject {
  const states = stateNames(document);
  return { ...(states.length > 1 ? { plane: { components: states.slice(0, 2) } } : {}), errors: states.slice(0, mostErrors) };
}

/** A changed document whose hints name states that it has. Hints of the reader's own stay as long as they do. */
export function withView(before: JsonObject, next: JsonObject): JsonObject {
  const view = objectAt(before, ['view']);
  if (Object.keys(view).length === 0 || equal(view, viewOf(before))) return put(next, ['view'], viewOf(next));
  const states = stateNames(next);
  const known = (names: unknown): boolean => Array.isArray(names) && names.every((name) => states.includes(String(name)));
  let kept = next;
  if (isObject(at(kept, ['view', 'plane'])) && !known(at(kept, ['view', 'plane', 'components']))) kept = put(kept, ['view', 'plane'], undefined);
  if (at(kept, ['view', 'errors']) !== undefined && !known(at(kept, ['view', 'errors']))) kept = put(kept, ['view', 'errors'], undefined);
  return kept;
}
