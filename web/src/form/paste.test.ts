import { describe, expect, it } from 'vitest';
import { lay, parseNumber, parseTable } from './paste';

describe('numbers as people write them', () => {
  it.each([
    ['1', 1], ['-2.5e-3', -0.0025], ['\u22123', -3], ['0,25', 0.25], ['1\u202f000', 1000], ['.5', 0.5], ['+4', 4],
  ])('%s', (text, value) => expect(parseNumber(text)).toBe(value));

  it.each(['', 'abc', '1e999', 'NaN', 'Infinity', '0x10', '1 2'])('refuses %s', (text) => expect(parseNumber(text)).toBeUndefined());
});

describe('pasted tables', () => {
  it('reads a spreadsheet, a MATLAB and a JSON matrix', () => {
    const wanted = { rows: [[1, 2], [3, 4]] };
    expect(parseTable('1\t2\r\n3\t4\r\n')).toEqual(wanted);
    expect(parseTable('[1 2; 3 4]')).toEqual(wanted);
    expect(parseTable('[[1, 2], [3, 4]]')).toEqual(wanted);
    expect(parseTable('1, 2\n3, 4')).toEqual(wanted);
    expect(parseTable('1,2\n3,4')).toEqual(wanted);
    expect(parseTable('1,5\t2,5')).toEqual({ rows: [[1.5, 2.5]] });
  });

  it('names the cell that is not a number', () => {
    expect(parseTable('1\t2\n3\tx')).toEqual({ row: 2, column: 2, cell: 'x' });
    expect(parseTable('1\t\n')).toEqual({ row: 1, column: 2, cell: '' });
  });

  it('lays rows over a table from a cell on, growing only where it may', () => {
    const table = [[0, 0], [0, 0]];
    expect(lay(table, [[1, 2], [3, 4]], 1, 1, false)).toEqual([[0, 0], [0, 1]]);
    expect(lay(table, [[1, 2], [3, 4]], 1, 1, true)).toEqual([[0, 0, 0], [0, 1, 2], [0, 3, 4]]);
    expect(table).toEqual([[0, 0], [0, 0]]);
  });
});
