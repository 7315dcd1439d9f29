/// What the page knows of the query language: enough to help writing it. The server alone decides what it means.

/** Fields that every run has; metrics and lanes come with the runs themselves. */
export const queryFields = ['id', 'scenario', 'family', 'state', 'seed', 'tags', 'note', 'created', 'started', 'ended', 'error', 'parent'] as const;

/** A value as the query language wants it: quoted where it is more than one plain word. */
export function quoted(value: string): string {
  if (/^[\p{L}\p{N}_.+-]+$/u.test(value) && !/^(and|or|not)$/i.test(value) && !value.includes('..')) return value;
  return `"${value.replaceAll('\\', '\\\\').replaceAll('"', '\\"')}"`;
}

/** The query with one more condition that has to hold as well. */
export function narrowed(query: string, term: string): string {
  const trimmed = query.trim();
  if (trimmed === '') return term;
  const needsParentheses = /(^|[\s)])OR([\s(]|$)/i.test(trimmed.replace(/"(\\.|[^"\\])*"/g, '""'));
  return `${needsParentheses ? `(${trimmed})` : trimmed} AND ${term}`;
}

/** Where the server's sentence says the query went wrong, counted from 1; undefined where it names no column. */
export function columnOf(sentences: readonly string[]): number | undefined {
  for (const sentence of sentences) {
    const found = /\bcolumn (\d+)/i.exec(sentence);
    if (found) return Number(found[1]);
  }
  return undefined;
}

/**
 * The query cut at the place of the fault: before it, the character itself (a space past the end), after it. Columns count
 * characters, not UTF-16 units.
 */
export function cutAt(query: string, column: number): { before: string; at: string; after: string } {
  const characters = [...query];
  const index = Math.min(Math.max(column - 1, 0), characters.length);
  return {
    before: characters.slice(0, index).join(''),
    at: characters[index] ?? ' ',
    after: characters.slice(index + 1).join(''),
  };
}
