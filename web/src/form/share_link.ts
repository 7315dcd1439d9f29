/// A whole document in a link: behind the #, which browsers keep to themselves, so that no server sees it.
import { isObject, type JsonObject } from './json';

/** Characters of a link; beyond that, mail and chat programs break it. */
export const longestLink = 32_768;
/** Bytes that a link may unfold to: someone else may have written it. */
const mostBytes = 1 << 20;
const key = 'doc';

async function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream, most: number): Promise<Uint8Array<ArrayBuffer> | null> {
  const writer = stream.writable.getWriter();
  // What goes wrong shows at the reader, too.
  writer.write(bytes).catch(() => undefined);
  writer.close().catch(() => undefined);
  const reader = stream.readable.getReader();
  const parts: Uint8Array[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > most) {
      await reader.cancel();
      return null;
    }
    parts.push(value);
  }
  const whole = new Uint8Array(length);
  parts.reduce((at, part) => (whole.set(part, at), at + part.length), 0);
  return whole;
}

function toText(bytes: Uint8Array): string {
  let binary = '';
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

function toBytes(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (character) => character.charCodeAt(0));
}

/** The link that opens `path` of this page with the document; may be longer than longestLink. */
export async function linkOf(path: string, document: JsonObject): Promise<string> {
  const packed = await through(new TextEncoder().encode(JSON.stringify(document)), new CompressionStream('deflate-raw'), Infinity);
  return `${location.origin}${path}#${key}=${toText(packed!)}`;
}

/** Whether the part of an address behind its # carries a document. */
export function carriesDocument(hash: string): boolean {
  return hash.startsWith(`#${key}=`);
}

/** The document that such a part carries; undefined where it cannot be read. */
export async function documentIn(hash: string): Promise<JsonObject | undefined> {
  const text = hash.slice(key.length + 2);
  if (!carriesDocument(hash) || text.length > longestLink) return undefined;
  try {
    const bytes = await through(toBytes(text), new DecompressionStream('deflate-raw'), mostBytes);
    return bytes ? parseDocument(new TextDecoder('utf-8', { fatal: true }).decode(bytes)) : undefined;
  } catch {
    return undefined;
  }
}

/** A document as it stands in a file or a link; undefined where the text is none. */
export function parseDocument(text: string): JsonObject | undefined {
  try {
    const value: unknown = JSON.parse(text, (name, inner: unknown) => (name === '__proto__' ? undefined : inner));
    return isObject(value as JsonObject) ? (value as JsonObject) : undefined;
  } catch {
    return undefined;
  }
}
