/// Tables as text, cut as the server cuts them: one row a line, commas, cells that may be quoted, blanks around them.

function trimmed(cell: string): string {
  const text = cell.replace(/^[ \t]+|[ \t]+$/g, '');
  return text.length >= 2 && text.startsWith('"') && text.endsWith('"') ? trimmed(text.slice(1, -1)) : text;
}

/** The cells of one line. */
export function cellsOf(line: string): string[] {
  const cells: string[] = [];
  let begin = 0;
  let quoted = false;
  for (let i = 0; i <= line.length; i++) {
    if (line[i] === '"') quoted = !quoted;
    if (i < line.length && (line[i] !== ',' || quoted)) continue;
    cells.push(trimmed(line.slice(begin, i)));
    begin = i + 1;
  }
  return cells;
}

/** Where the lines of a text begin and end, without line ends and a byte order mark; empty lines at its end are none. */
export function* linesOf(text: string): Generator<string> {
  const end = text.search(/[\r\n]*$/);
  let begin = text.startsWith('\uFEFF') ? 1 : 0;
  while (begin < end) {
    const next = text.indexOf('\n', begin);
    const stop = next < 0 || next > end ? end : next;
    yield text.slice(begin, text[stop - 1] === '\r' ? stop - 1 : stop);
    begin = stop + 1;
  }
}

/** The header and the first rows of a table. */
export function headOf(text: string, rows: number): { names: string[]; rows: string[][] } {
  const head: string[][] = [];
  for (const line of linesOf(text)) {
    head.push(cellsOf(line));
    if (head.length > rows) break;
  }
  return { names: head[0] ?? [], rows: head.slice(1) };
}

/** Whether a table's header is that of a trace. */
export function isTraceHeader(names: readonly string[]): boolean {
  return names[0] === 'k' && names[1] === 't';
}
