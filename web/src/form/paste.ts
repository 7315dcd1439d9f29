/** Cells of a spreadsheet or a typed list, read as numbers. */
export type Pasted = { rows: number[][] } | { row: number; column: number; cell: string };

const kNumber = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** One number as people write it: minus sign (U+2212), thousands apart by thin spaces, decimal comma; undefined where it is none. */
export function parseNumber(text: string): number | undefined {
  const plain = text.trim().replaceAll('\u2212', '-').replace(/[\u2009\u202f\u00a0]/g, '');
  const dotted = /^[+-]?\d+,\d+$/.test(plain) ? plain.replace(',', '.') : plain;
  if (!kNumber.test(dotted)) return undefined;
  const value = Number(dotted);
  return Number.isFinite(value) ? value : undefined;
}

/**
 * Rows of what was pasted: tabs (a spreadsheet), else semicolons, else commas or spaces between cells; MATLAB's and JSON's
 * brackets are taken off. Answers the first cell that is not a number with its place, counted from 1.
 */
export function parseTable(text: string): Pasted {
  let body = text.replace(/\r\n?/g, '\n').replace(/^[\n ]+|[\n ]+$/g, '');
  if (body.startsWith('[')) {
    body = body.replace(/\]\s*,\s*\[/g, '\n').replace(/[[\]]/g, '').trim();
    if (!body.includes('\t')) body = body.replaceAll(';', '\n');
  }
  const separator = body.includes('\t') ? /\t/ : body.includes(';') ? /\s*;\s*/ : /\s*,\s+|\s+|,/;
  const rows: number[][] = [];
  for (const line of body.split('\n')) {
    if (line.trim() === '') continue;
    const trimmed = separator.source === '\\t' ? line : line.trim().replace(/,$/, '');
    const row: number[] = [];
    for (const cell of trimmed.split(separator)) {
      const value = parseNumber(cell);
      if (value === undefined) return { row: rows.length + 1, column: row.length + 1, cell: cell.trim() };
      row.push(value);
    }
    rows.push(row);
  }
  return { rows };
}

/** Pasted rows laid over a table from a given cell on; what sticks out is cut where the size is fixed. */
export function lay(table: number[][], rows: number[][], row: number, column: number, grow: boolean): number[][] {
  const result = table.map((line) => [...line]);
  rows.forEach((line, i) => {
    if (row + i >= result.length) {
      if (!grow) return;
      result.push(new Array<number>(Math.max(result[0]?.length ?? 0, column + line.length)).fill(0));
    }
    const target = result[row + i]!;
    line.forEach((value, j) => {
      if (column + j < target.length || grow) target[column + j] = value;
    });
  });
  const width = Math.max(0, ...result.map((line) => line.length));
  return result.map((line) => Array.from({ length: width }, (_, j) => line[j] ?? 0));
}
