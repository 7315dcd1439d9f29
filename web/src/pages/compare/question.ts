/// What is compared, and how: kept in the address, so that a link shows the same.

export interface Question {
  ids: string[];
  signals: string;
  align: 'tick' | 'attack';
  /** As typed: the server judges them. */
  abs: string;
  rel: string;
  shift: string;
  from: string;
  to: string;
}

export const leastRuns = 2;
export const mostRuns = 10;

export function readQuestion(query: URLSearchParams): Question {
  const text = (key: string): string => query.get(key)?.trim() ?? '';
  return {
    ids: splitIds(text('ids')),
    signals: text('signals'),
    align: text('align') === 'attack' ? 'attack' : 'tick',
    abs: text('abs'),
    rel: text('rel'),
    shift: text('shift'),
    from: text('from'),
    to: text('to'),
  };
}

/** What goes into the address; null removes what is as usual. */
export function writeQuestion(question: Question): Record<string, string | null> {
  return {
    ids: question.ids.join(','),
    signals: question.signals || null,
    align: question.align === 'attack' ? 'attack' : null,
    abs: question.abs || null,
    rel: question.rel || null,
    shift: question.shift || null,
    from: question.from || null,
    to: question.to || null,
  };
}

/** Ids as a reader may type them: "3, 5 8", each once. */
export function splitIds(text: string): string[] {
  return [...new Set(text.split(/[\s,，、]+/).filter(Boolean))];
}

/** The page that compares these runs. The oldest is what the others are measured by. */
export function compareAddress(ids: readonly string[]): string {
  const sorted = [...ids].sort((a, b) => a.length - b.length || (a < b ? -1 : 1));
  return `/compare?ids=${sorted.map(encodeURIComponent).join(',')}`;
}

/** Ids with one of them first. */
export function withBase(ids: readonly string[], base: string): string[] {
  return [base, ...ids.filter((id) => id !== base)];
}
