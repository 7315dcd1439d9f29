import { equal, isObject, type Json, type JsonObject } from './json';

/** What the form reads of JSON Schema (draft 2020-12) and of Vigil's own x- keywords. */
export interface Schema {
  $ref?: string;
  $defs?: Record<string, Schema>;
  type?: string | string[];
  title?: string;
  description?: string;
  default?: Json;
  const?: Json;
  enum?: Json[];
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  exclusiveMaximum?: number;
  minLength?: number;
  maxLength?: number;
  pattern?: string;
  items?: Schema | boolean;
  prefixItems?: Schema[];
  minItems?: number;
  maxItems?: number;
  properties?: Record<string, Schema>;
  required?: string[];
  additionalProperties?: Schema | boolean;
  patternProperties?: Record<string, Schema>;
  propertyNames?: Schema;
  allOf?: Schema[];
  anyOf?: Schema[];
  oneOf?: Schema[];
  if?: Schema;
  then?: Schema;
  else?: Schema;
  readOnly?: boolean;
  'x-zh'?: Json;
  'x-unit'?: string;
  'x-symbol'?: string;
  'x-live'?: boolean;
  'x-source'?: string;
  'x-labels'?: JsonObject;
}

const kDepth = 12;

function typeOf(value: Json): string {
  if (value === null) return 'null';
  if (Array.isArray(value)) return 'array';
  return typeof value;
}

export function typesOf(schema: Schema): string[] {
  if (typeof schema.type === 'string') return [schema.type];
  return schema.type ?? [];
}

/** A schema with its local references followed. */
export function follow(schema: Schema, root: Schema): Schema {
  let here = schema;
  for (let depth = 0; here.$ref !== undefined && depth < kDepth; depth += 1) {
    const { $ref, ...beside } = here;
    let target: Json | undefined = root as unknown as Json;
    for (const step of $ref.replace(/^#\/?/, '').split('/').filter((part) => part !== '')) {
      target = isObject(target) ? target[step.replaceAll('~1', '/').replaceAll('~0', '~')] : undefined;
    }
    here = { ...((target ?? {}) as unknown as Schema), ...beside };
  }
  return here;
}

/** Whether a value is of a branch: types, constants and choices only, deep enough to tell one branch from another. */
function fits(schema: Schema, value: Json | undefined, root: Schema, depth = 0): boolean {
  const own = follow(schema, root);
  if (value === undefined || depth > kDepth) return true;
  if (own.const !== undefined && !equal(own.const, value)) return false;
  if (own.enum !== undefined && !own.enum.some((choice) => equal(choice, value))) return false;
  const types = typesOf(own);
  const type = typeOf(value);
  if (types.length > 0 && !types.includes(type) && !(types.includes('integer') && type === 'number')) return false;
  if (own.allOf?.some((part) => !fits(part, value, root, depth + 1))) return false;
  if (own.anyOf && !own.anyOf.some((part) => fits(part, value, root, depth + 1))) return false;
  if (Array.isArray(value) && typeof own.items === 'object' && !fits(own.items, value[0], root, depth + 1)) return false;
  if (!isObject(value)) return true;
  if (own.required?.some((key) => !Object.hasOwn(value, key))) return false;
  return Object.entries(own.properties ?? {}).every(([key, part]) => fits(part, value[key], root, depth + 1));
}

function merge(a: Schema, b: Schema): Schema {
  const properties: Record<string, Schema> = { ...a.properties };
  for (const [key, part] of Object.entries(b.properties ?? {})) {
    const before = properties[key];
    properties[key] = before ? merge(before, part) : part;
  }
  const merged: Schema = { ...a, ...b };
  if (Object.keys(properties).length > 0) merged.properties = properties;
  if (a.required || b.required) merged.required = [...(a.required ?? []), ...(b.required ?? [])];
  return merged;
}

/**
 * The schema that holds for this value: references followed, allOf and if/then/else merged in, the branch of oneOf or anyOf
 * chosen that the value is of (the first one that is not null where none is).
 */
export function resolve(schema: Schema, value: Json | undefined, root: Schema, depth = 0): Schema {
  const { allOf, anyOf, oneOf, if: condition, then, else: otherwise, ...plain } = follow(schema, root);
  let result: Schema = plain;
  if (depth > kDepth) return result;
  for (const part of allOf ?? []) result = merge(result, resolve(part, value, root, depth + 1));
  if (condition) {
    const branch = value !== undefined && fits(condition, value, root) ? then : otherwise;
    if (branch) result = merge(result, resolve(branch, value, root, depth + 1));
  }
  const branches = anyOf ?? oneOf;
  if (branches) {
    const real = branches.filter((part) => !typesOf(follow(part, root)).every((type) => type === 'null') || !follow(part, root).type);
    const chosen = real.find((part) => value !== null && fits(part, value, root)) ?? real[0];
    if (chosen) result = merge(result, resolve(chosen, value, root, depth + 1));
    if (real.length < branches.length) result.type = [...new Set([...typesOf(result), 'null'])];
  }
  return result;
}

/** Whether null is allowed: by type, or by a branch of its own. */
export function isNullable(schema: Schema, root: Schema): boolean {
  const own = follow(schema, root);
  if (typesOf(own).includes('null') || own.enum?.includes(null)) return true;
  return [...(own.anyOf ?? []), ...(own.oneOf ?? [])].some((part) => isNullable(part, root));
}

/** The values a member may take, where they can be listed: an enum, or the constants of its branches. */
export function choicesOf(schema: Schema, root: Schema): Json[] {
  const own = follow(schema, root);
  if (own.enum) return own.enum.filter((choice) => choice !== null);
  const branches = own.oneOf ?? own.anyOf ?? [];
  const constants = branches.map((part) => follow(part, root).const).filter((value) => value !== undefined);
  return constants.length > 0 ? constants.filter((value) => value !== null) : [];
}

/** The values that one member takes over all branches of an object's schema: the methods a lane can have, an attack's types. */
export function constantsOf(schema: Schema, key: string, root: Schema, depth = 0): string[] {
  const own = follow(schema, root);
  if (depth > kDepth) return [];
  const member = own.properties?.[key];
  const found: string[] = [];
  if (member) {
    const direct = follow(member, root);
    if (typeof direct.const === 'string') found.push(direct.const);
    for (const choice of choicesOf(direct, root)) if (typeof choice === 'string') found.push(choice);
  }
  const inner = [...(own.oneOf ?? []), ...(own.anyOf ?? []), ...(own.allOf ?? [])];
  if (own.then) inner.push(own.then);
  for (const part of inner) found.push(...constantsOf(part, key, root, depth + 1));
  return [...new Set(found)];
}
