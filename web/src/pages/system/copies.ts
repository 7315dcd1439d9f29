/// Copies of a saved description: a free id, and a title that says which copy it is.
import { isObject, type JsonObject } from '../../form/json';

const longest = 64;

/** The id that nothing bears yet: the wanted one with -2, -3, … behind it. */
export function freeName(taken: ReadonlySet<string>, wanted: string): string {
  const stem = wanted.replace(/-\d+$/, '').slice(0, longest - 4);
  for (let n = 2; ; n += 1) if (!taken.has(`${stem}-${n}`)) return `${stem}-${n}`;
}

/** The document as a copy under that id. */
export function renamed(document: JsonObject, id: string): JsonObject {
  const { title } = document;
  const of = (text: unknown): string => `${String(text ?? '').replace(/ \([^()]*\)$/, '')} (${id})`.trim();
  return { ...document, id, title: isObject(title) ? { en: of(title.en), zh: of(title.zh) } : of(title) };
}
