import { describe, expect, it } from 'vitest';
import { glossary } from './glossary';
import { operationsOf } from './openapi';

describe('glossary', () => {
  it('has every term and meaning in both languages, once', () => {
    for (const { term, meaning } of glossary) {
      expect(term.zh).toMatch(/\p{Script=Han}/u);
      expect(meaning.zh).toMatch(/\p{Script=Han}/u);
      expect(meaning.en.length).toBeGreaterThan(20);
    }
    expect(new Set(glossary.map(({ term }) => term.en)).size).toBe(glossary.length);
  });
});

describe('API reference', () => {
  it('lists the operations and passes over what is none', () => {
    const document = {
      paths: {
        '/api/v1/runs': { get: { summary: 'List' }, post: { description: 'Start' }, parameters: [] },
        '/healthz': { get: {} },
        '/odd': null,
      },
    };
    expect(operationsOf(document)).toEqual([
      { method: 'GET', path: '/api/v1/runs', summary: 'List' },
      { method: 'POST', path: '/api/v1/runs', summary: 'Start' },
      { method: 'GET', path: '/healthz', summary: '' },
    ]);
    expect(operationsOf(null)).toEqual([]);
    expect(operationsOf({ paths: 3 })).toEqual([]);
  });
});
