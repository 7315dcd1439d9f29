import { isObject, type Json, type JsonObject } from './json';

/** JSON pointer (RFC 6901) to its steps; "" is the whole document. */
export function steps(pointer: string): string[] {
  if (pointer === '') return [];
  return pointer
    .replace(/^\//, '')
    .split('/')
    .map((step) => step.replaceAll('~1', '/').replaceAll('~0', '~'));
}

export function pointer(path: readonly string[]): string {
  return path.map((step) => '/' + step.replaceAll('~', '~0').replaceAll('/', '~1')).join('');
}

/** The value at a path, undefined where the path leads nowhere. */
export function at(value: Json | undefined, path: readonly string[]): Json | undefined {
  let here = value;
  for (const step of path) {
    if (Array.isArray(here)) here = /^\d+$/.test(step) ? here[Number(step)] : undefined;
    else if (isObject(here)) here = Object.hasOwn(here, step) ? here[step] : undefined;
    else return undefined;
  }
  return here;
}

/**
 * A document with one member replaced, sharing the untouched rest. undefined removes the member; objects missing on the way
 * are made.
 */
export function put(document: JsonObject, path: readonly string[], value: Json | undefined): JsonObject {
  const [first, ...rest] = path;
  if (first === undefined) return isObject(value) ? value : document;
  const result: JsonObject = { ...document };
  if (rest.length === 0) {
    if (value === undefined) delete result[first];
    else result[first] = value;
    return result;
  }
  const child = result[first];
  if (Array.isArray(child)) {
    const items = [...child];
    const index = Number(rest[0]);
    const item = items[index];
    if (rest.length === 1) items[index] = value ?? null;
    else items[index] = put(isObject(item) ? item : {}, rest.slice(1), value);
    result[first] = items;
  } else {
    result[first] = put(isObject(child) ? child : {}, rest, value);
  }
  return result;
}
