import { isObject, type JsonObject } from './json';

const kLongest = 32_768;

/** A patch as it stands in the address bar; empty for no change. */
export function writePatch(patch: JsonObject): string {
  return Object.keys(patch).length === 0 ? '' : JSON.stringify(patch);
}

/** A patch from the address bar: undefined where it is none. Someone else may have written it, so it is read with care. */
export function readPatch(text: string | null): JsonObject | undefined {
  if (text === null || text === '') return {};
  if (text.length > kLongest) return undefined;
  try {
    const value: unknown = JSON.parse(text, (key, inner: unknown) => (key === '__proto__' ? undefined : inner));
    return isObject(value as JsonObject) ? (value as JsonObject) : undefined;
  } catch {
    return undefined;
  }
}
