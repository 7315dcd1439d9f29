import type { Json, JsonObject } from '../../form/json';
import { changes } from '../../form/patch';

/** Members that say which scenario it is, not how it runs. */
const kNames = new Set(['id', 'title', 'source', 'view', 'vigil', 'family']);

export interface ChangedParameter {
  /** Dotted, as --set takes it. */
  path: string;
  /** Its last steps, short enough for a cell. */
  short: string;
  from: string;
  to: string;
}

function written(value: Json | undefined): string {
  if (value === undefined) return '–';
  const text = typeof value === 'string' ? value : JSON.stringify(value);
  return text.length > 60 ? `${text.slice(0, 57)}…` : text;
}

/** In what a run differs from the scenario it names. */
export function changedParameters(scenario: JsonObject, run: JsonObject): ChangedParameter[] {
  return changes(scenario, run)
    .filter(({ path }) => !kNames.has(path[0] ?? ''))
    .map(({ path, from, to }) => {
      const steps = path.filter((step) => step !== 'params');
      return { path: path.join('.'), short: steps.slice(-2).join('.'), from: written(from), to: written(to) };
    });
}
