import { describe, expect, it } from 'vitest';
import { formatBytes, formatDuration, formatNumber, missing } from './format.svelte';
import { dictionaries, language } from './i18n.svelte';
import { shellWords } from './shell_words';
import { significant } from './significant';

// Every dictionary of the page registers itself when its module is loaded.
const modules = import.meta.glob(['../**/*words.ts'], { eager: true });

const placeholders = (text: string): string[] => [...text.matchAll(/\{\w+\}/g)].map((match) => match[0]).sort();

describe('languages', () => {
  it('every dictionary is there', () => {
    expect(Object.keys(modules).length).toBeGreaterThanOrEqual(3);
    expect(dictionaries().size).toBeGreaterThanOrEqual(Object.keys(modules).length);
  });

  it.each([...dictionaries()].map(([name, words]) => ({ name, ...words })))('$name says the same in both, with the same places for values', ({ en, zh }) => {
    expect(Object.keys(zh).sort()).toEqual(Object.keys(en).sort());
    for (const key of Object.keys(en)) {
      expect(zh[key]!.trim(), key).not.toBe('');
      expect(placeholders(zh[key]!), key).toEqual(placeholders(en[key]!));
    }
  });

  it('switches the text and the document', () => {
    language.set('zh');
    expect(shellWords('runs')).toBe('运行');
    expect(document.documentElement.lang).toBe('zh-CN');
    expect(new URLSearchParams(location.search).get('lang')).toBe('zh');
    language.set('en');
    expect(shellWords('runs')).toBe('Runs');
  });
});

describe('numbers', () => {
  it.each([
    [8.1349, '8.13'],
    [22.21, '22.2'],
    [0.0412, '0.0412'],
    [1234.5, '1235'],
    [123456, '1.23e+5'],
    [0.00001234, '1.23e-5'],
    [0, '0'],
    [-2.5, '-2.50'],
  ])('%d is %s', (value, text) => expect(significant(value, 3)).toBe(text));

  it('a missing number is a dash, never 0', () => {
    for (const value of [null, undefined, NaN, Infinity]) expect(formatNumber(value)).toBe(missing);
  });

  it('times and sizes', () => {
    expect([4.24, 65, 7321].map(formatDuration)).toEqual(['4.2 s', '1 min 05 s', '2 h 02 min']);
    expect([999, 1234, 12_400_000].map(formatBytes)).toEqual(['999 B', '1.23 kB', '12.4 MB']);
  });
});
