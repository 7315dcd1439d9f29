import { equal, isObject, type Json, type JsonObject } from './json';

/** JSON Merge Patch (RFC 7396) applied to a document; neither argument is changed. */
export function apply(target: Json | undefined, patch: Json): Json {
  if (!isObject(patch)) return patch;
  const result: JsonObject = isObject(target) ? { ...target } : {};
  for (const [key, value] of Object.entries(patch)) {
    if (value === null) delete result[key];
    else result[key] = apply(result[key], value);
  }
  return result;
}

/** The smallest merge patch that leads from one document to another. Members that become null are removed by it. */
export function diff(from: JsonObject, to: JsonObject): JsonObject {
  const patch: JsonObject = {};
  for (const key of Object.keys(from)) if (!Object.hasOwn(to, key)) patch[key] = null;
  for (const [key, value] of Object.entries(to)) {
    const old = from[key];
    if (equal(old, value)) continue;
    patch[key] = isObject(old) && isObject(value) ? diff(old, value) : value;
  }
  return patch;
}

/** One difference between a scenario and what was run: from or to is undefined where the member is missing there. */
export interface Change {
  path: string[];
  from: Json | undefined;
  to: Json | undefined;
}

/** The leaves in which two documents differ, in the order of the second, removals last. */
export function changes(from: Json | undefined, to: Json | undefined, path: string[] = []): Change[] {
  if (equal(from, to)) return [];
  if (!isObject(from) || !isObject(to)) return [{ path, from, to }];
  const keys = [...Object.keys(to), ...Object.keys(from).filter((key) => !Object.hasOwn(to, key))];
  return keys.flatMap((key) => changes(from[key], to[key], [...path, key]));
}

/**
 * Whether the patch really leads there. A merge patch cannot set a member to null (it removes it), which matters where a
 * parameter's default is not null; then the whole document has to be sent.
 */
export function isExact(from: JsonObject, to: JsonObject, defaultAt: (path: string[]) => Json | undefined): boolean {
  const reached = apply(from, diff(from, to));
  return changes(reached, to).every(({ path, from: got, to: wanted }) => {
    return got === undefined && wanted === null && (defaultAt(path) ?? null) === null;
  });
}
