import { describe, expect, test } from 'vitest';
import { cellsOf, headOf, isTraceHeader, linesOf } from './csv_text';

describe('tables as text', () => {
  test('cells are cut at commas outside quotes, and trimmed as the server does', () => {
    expect(cellsOf(' a , "b, c" ,,"d"')).toEqual(['a', 'b, c', '', 'd']);
    expect(cellsOf('" e "')).toEqual(['e']);
    expect(cellsOf('')).toEqual(['']);
  });

  test('lines end in LF or CRLF; a mark at the beginning and empty lines at the end are none', () => {
    expect([...linesOf('\uFEFFa,b\r\n1,2\n\n3,4\r\n\r\n')]).toEqual(['a,b', '1,2', '', '3,4']);
    expect([...linesOf('a')]).toEqual(['a']);
    expect([...linesOf('\n')]).toEqual([]);
    expect([...linesOf('')]).toEqual([]);
  });

  test('the head is the header and no more rows than asked for', () => {
    expect(headOf('a,b\n1,2\n3,4\n5,6', 2)).toEqual({ names: ['a', 'b'], rows: [['1', '2'], ['3', '4']] });
    expect(headOf('', 2)).toEqual({ names: [], rows: [] });
  });

  test('a trace begins with k and t', () => {
    expect(isTraceHeader(['k', 't', 'truth.x'])).toBe(true);
    expect(isTraceHeader(['t', 'k'])).toBe(false);
    expect(isTraceHeader([])).toBe(false);
  });
});
