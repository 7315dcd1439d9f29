/// Patterns like `/runs/:id` against a path. Returns the named parts, decoded, or null.
export function matchPath(pattern: string, path: string): Record<string, string> | null {
  const wanted = pattern.split('/').filter(Boolean);
  const given = path.split('/').filter(Boolean);
  if (wanted.length !== given.length) return null;
  const params: Record<string, string> = {};
  for (let i = 0; i < wanted.length; i++) {
    const want = wanted[i]!;
    const have = given[i]!;
    if (!want.startsWith(':')) {
      if (want !== have) return null;
      continue;
    }
    try {
      params[want.slice(1)] = decodeURIComponent(have);
    } catch {
      return null;
    }
  }
  return params;
}
