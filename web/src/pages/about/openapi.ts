/** One row of the reference table. */
export interface Operation {
  method: string;
  path: string;
  summary: string;
}

const kMethods = ['get', 'post', 'put', 'patch', 'delete'];

/** The operations of an OpenAPI document in its order; anything in it that is not as expected is passed over. */
export function operationsOf(document: unknown): Operation[] {
  const paths = (document as { paths?: unknown } | null)?.paths;
  if (typeof paths !== 'object' || paths === null) return [];
  return Object.entries(paths).flatMap(([path, item]) => {
    if (typeof item !== 'object' || item === null) return [];
    return kMethods.flatMap((method) => {
      const operation = (item as Record<string, unknown>)[method] as { summary?: unknown; description?: unknown } | undefined;
      if (typeof operation !== 'object' || operation === null) return [];
      const summary = [operation.summary, operation.description].find((text) => typeof text === 'string' && text !== '');
      return [{ method: method.toUpperCase(), path, summary: typeof summary === 'string' ? summary : '' }];
    });
  });
}
