/// The address bar is the page's state: path for the page, query for what is seen on it.
let path = $state(location.pathname);
let search = $state(location.search);

export const router = {
  get path(): string {
    return path;
  },
  get search(): string {
    return search;
  },
  get query(): URLSearchParams {
    return new URLSearchParams(search);
  },
};

addEventListener('popstate', refresh);

function refresh(): void {
  path = location.pathname;
  search = location.search;
}

/** One value of the query, outside any reactive context. */
export function readQuery(key: string): string | null {
  return new URLSearchParams(location.search).get(key);
}

/** Adds the language and theme of this address to `to`, so that a link copied later shows the same. */
export function withPreferences(to: string): string {
  const url = new URL(to, location.origin);
  const now = new URLSearchParams(location.search);
  for (const key of ['lang', 'theme']) {
    const value = now.get(key);
    if (value !== null && !url.searchParams.has(key)) url.searchParams.set(key, value);
  }
  return url.pathname + url.search + url.hash;
}

/** Goes to an address of this page, e.g. `/live/17`. */
export function navigate(to: string, options: { replace?: boolean } = {}): void {
  const target = withPreferences(to);
  if (options.replace) history.replaceState(null, '', target);
  else history.pushState(null, '', target);
  refresh();
  if (!options.replace) document.getElementById('main')?.focus({ preventScroll: true });
}

/** Changes some values of the query in place; null or "" removes one. Makes no history entry. */
export function setQuery(changes: Record<string, string | number | null>): void {
  const query = new URLSearchParams(location.search);
  for (const [key, value] of Object.entries(changes)) {
    if (value === null || value === '') query.delete(key);
    else query.set(key, String(value));
  }
  const text = query.toString();
  const next = location.pathname + (text ? `?${text}` : '') + location.hash;
  if (next === location.pathname + location.search + location.hash) return;
  history.replaceState(history.state, '', next);
  refresh();
}

/** Lets plain `<a href>` inside `node` move within the page without a reload. */
export function internalLinks(node: HTMLElement): { destroy(): void } {
  const onClick = (event: MouseEvent): void => {
    if (event.defaultPrevented || event.button !== 0 || event.metaKey || event.ctrlKey || event.shiftKey || event.altKey) return;
    const anchor = (event.target as Element | null)?.closest('a[href]');
    if (!(anchor instanceof HTMLAnchorElement) || anchor.target || anchor.hasAttribute('download')) return;
    const url = new URL(anchor.href);
    if (url.origin !== location.origin || url.pathname.startsWith('/api/')) return;
    event.preventDefault();
    navigate(url.pathname + url.search + url.hash);
  };
  node.addEventListener('click', onClick);
  return { destroy: () => node.removeEventListener('click', onClick) };
}
