import type { Field } from './fields';
import { equal, type Json } from './json';
import { steps } from './pointer';

/** What is wrong with a value; the page puts it into words. */
export type Fault =
  | { code: 'missing' }
  | { code: 'number'; text: string }
  | { code: 'integer' }
  | { code: 'range'; low: number | undefined; high: number | undefined; openLow: boolean; openHigh: boolean }
  | { code: 'choice'; choices: Json[] }
  | { code: 'size'; least: number | undefined; most: number | undefined }
  | { code: 'ragged' }
  | { code: 'pattern'; pattern: string }
  | { code: 'json' };

function outside(field: Field, value: number): boolean {
  return (
    (field.minimum !== undefined && value < field.minimum) ||
    (field.maximum !== undefined && value > field.maximum) ||
    (field.exclusiveMinimum !== undefined && value <= field.exclusiveMinimum) ||
    (field.exclusiveMaximum !== undefined && value >= field.exclusiveMaximum)
  );
}

export function rangeOf(field: Field): Fault & { code: 'range' } {
  return {
    code: 'range',
    low: field.exclusiveMinimum ?? field.minimum,
    high: field.exclusiveMaximum ?? field.maximum,
    openLow: field.exclusiveMinimum !== undefined,
    openHigh: field.exclusiveMaximum !== undefined,
  };
}

function checkNumber(field: Field, value: Json): Fault | undefined {
  if (typeof value !== 'number' || !Number.isFinite(value)) return { code: 'number', text: String(value) };
  if (field.kind === 'integer' && !Number.isInteger(value)) return { code: 'integer' };
  return outside(field, value) ? rangeOf(field) : undefined;
}

function checkItems(field: Field, value: Json): Fault | undefined {
  if (!Array.isArray(value)) return { code: 'json' };
  const short = field.minItems !== undefined && value.length < field.minItems;
  const long = field.maxItems !== undefined && value.length > field.maxItems;
  if (short || long) return { code: 'size', least: field.minItems, most: field.maxItems };
  if (field.kind === 'list') return value.every((item) => typeof item === 'string') ? undefined : { code: 'json' };
  const rows = field.kind === 'matrix' ? value : [value];
  const width = Array.isArray(rows[0]) ? rows[0].length : 0;
  for (const row of rows) {
    if (!Array.isArray(row)) return { code: 'json' };
    if (row.length !== width) return { code: 'ragged' };
    for (const item of row) {
      const fault = checkNumber(field, item);
      if (fault) return fault;
    }
  }
  return undefined;
}

/** The first fault of a value for its field; undefined where the form can find none (the server has the last word). */
export function check(field: Field, value: Json | undefined): Fault | undefined {
  if (value === undefined) return field.required ? { code: 'missing' } : undefined;
  if (value === null) return field.nullable ? undefined : { code: 'missing' };
  switch (field.kind) {
    case 'number':
    case 'integer':
      return checkNumber(field, value);
    case 'choice':
      return field.choices.some((choice) => equal(choice, value)) ? undefined : { code: 'choice', choices: field.choices };
    case 'vector':
    case 'matrix':
    case 'list':
      return checkItems(field, value);
    case 'text':
      if (typeof value !== 'string') return { code: 'json' };
      return field.pattern !== undefined && !new RegExp(field.pattern, 'u').test(value)
        ? { code: 'pattern', pattern: field.pattern }
        : undefined;
    default:
      return undefined;
  }
}

/** A problem as the server names it (RFC 9457's errors). */
export interface ServerProblem {
  pointer: string;
  detail: string;
  allowed?: string | null;
}

export interface Placed {
  /** By the field's pointer. */
  byField: Map<string, ServerProblem[]>;
  /** Those that belong to no field, shown above the form. */
  rest: ServerProblem[];
  /** The first field with a problem, in the form's order. */
  first: string | undefined;
}

/** The document's pointer where the server speaks of the request's body: /patch/…, /scenario/…, /document/…. */
function inDocument(pointer: string): string {
  return pointer.replace(/^\/(patch|scenario|document)(?=\/)/, '');
}

function holder(pointer: string, fields: readonly Field[]): Field | undefined {
  const wanted = steps(pointer);
  let best: Field | undefined;
  for (const field of fields) {
    const inside = field.path.every((step, i) => wanted[i] === step);
    if (inside && field.path.length > (best?.path.length ?? 0)) best = field;
  }
  return best ?? fields.find((field) => wanted.length > 0 && wanted.every((step, i) => field.path[i] === step));
}

/** Puts each of the server's problems to the field it speaks of: the field itself, the one that holds it, the first in it. */
export function place(problems: readonly ServerProblem[], fields: readonly Field[]): Placed {
  const placed: Placed = { byField: new Map(), rest: [], first: undefined };
  for (const problem of problems) {
    const field = holder(inDocument(problem.pointer), fields);
    if (!field) placed.rest.push(problem);
    else placed.byField.set(field.pointer, [...(placed.byField.get(field.pointer) ?? []), problem]);
  }
  placed.first = fields.find((field) => placed.byField.has(field.pointer))?.pointer;
  return placed;
}
