/// The view as text in the address, and back.
export interface ViewState {
  /** null: the newest `width` ticks, moving with the run. */
  range: { from: number; to: number } | null;
  width: number;
  cursor: number | null;
  lane: string | null;
  node: string | null;
  hidden: readonly string[];
  /** Signals picked by hand. */
  signals: readonly string[];
  errors: 'lanes' | 'nodes';
  /** Curves of a fusion centre's lanes that are switched from how they begin. */
  curves: readonly string[];
}

export const defaultWidth = 120;

function whole(text: string | null): number | null {
  if (text === null || !/^\d{1,15}$/.test(text)) return null;
  return Number(text);
}

function list(text: string | null): string[] {
  return text ? text.split(',').filter(Boolean) : [];
}

/** Reads the query; what is malformed counts as not given. */
export function parseView(read: (key: string) => string | null): ViewState {
  const parts = (read('range') ?? '').split('-');
  const from = whole(parts[0] ?? null);
  const to = whole(parts[1] ?? null);
  const width = whole(read('width'));
  return {
    range: parts.length === 2 && from !== null && to !== null && to > from ? { from, to } : null,
    width: width !== null && width >= 10 ? width : defaultWidth,
    cursor: whole(read('k')),
    lane: read('lane') || null,
    node: read('node') || null,
    hidden: list(read('hide')),
    signals: list(read('signals')),
    errors: read('errors') === 'nodes' ? 'nodes' : 'lanes',
    curves: list(read('curves')),
  };
}

export function viewQuery(view: ViewState): Record<string, string | number | null> {
  return {
    range: view.range ? `${view.range.from}-${view.range.to}` : null,
    width: view.width === defaultWidth ? null : view.width,
    k: view.cursor,
    lane: view.lane,
    node: view.node,
    hide: view.hidden.join(',') || null,
    signals: view.signals.join(',') || null,
    errors: view.errors === 'lanes' ? null : view.errors,
    curves: view.curves.join(',') || null,
  };
}
