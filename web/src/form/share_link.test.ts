import { describe, expect, it } from 'vitest';
import type { JsonObject } from './json';
import { carriesDocument, documentIn, linkOf, longestLink, parseDocument } from './share_link';

const document: JsonObject = { vigil: 1, id: 'mine', title: { en: 'Tank — two', zh: '两个水箱' }, plant: { type: 'linear', params: { A: [[1.1, 1e-17], [0, 0.30000000000000004]] } } };
const hashOf = (link: string): string => new URL(link).hash;

describe('a document in a link', () => {
  it('comes out as it went in, to the last digit and in any script', async () => {
    const link = await linkOf('/system?kind=linear', document);
    expect(link.startsWith(`${location.origin}/system?kind=linear#doc=`)).toBe(true);
    expect(link).toMatch(/#doc=[\w-]+$/);
    expect(carriesDocument(hashOf(link))).toBe(true);
    expect(await documentIn(hashOf(link))).toEqual(document);
  });

  it('stands behind the #, where no server sees it', async () => {
    const url = new URL(await linkOf('/system', document));
    expect(url.search).toBe('');
    expect(url.pathname).toBe('/system');
  });

  it('is shorter than its text where matrices repeat themselves', async () => {
    const large: JsonObject = { A: Array.from({ length: 12 }, (_, i) => Array.from({ length: 12 }, (__, j) => (i === j ? 0.9 : 0))) };
    expect((await linkOf('/system', large)).length).toBeLessThan(JSON.stringify(large).length / 2);
  });

  it('is not read where it is cut off, no base64, no object, or unfolds to more than a megabyte', async () => {
    const hash = hashOf(await linkOf('/system', document));
    expect(await documentIn(hash.slice(0, -6))).toBeUndefined();
    expect(await documentIn('#doc=%%%')).toBeUndefined();
    expect(await documentIn('#other=abc')).toBeUndefined();
    expect(await documentIn(hashOf(await linkOf('/system', { text: 'a'.repeat(2 << 20) })))).toBeUndefined();
    expect(await documentIn(`#doc=${'a'.repeat(longestLink + 1)}`)).toBeUndefined();
    expect(parseDocument('[1]')).toBeUndefined();
    expect(parseDocument('{')).toBeUndefined();
  });

  it('brings no prototype with it', () => {
    expect(Object.keys(parseDocument('{"a":1,"__proto__":{"b":2}}')!)).toEqual(['a']);
  });
});
