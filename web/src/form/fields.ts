import { isObject, type Json } from './json';
import { pointer } from './pointer';
import { choicesOf, follow, isNullable, resolve, typesOf, type Schema } from './schema';

export interface Words {
  en: string;
  zh: string;
}

export type Kind = 'number' | 'integer' | 'text' | 'choice' | 'boolean' | 'vector' | 'matrix' | 'list' | 'json' | 'constant';

/** One thing the form asks for. */
export interface Field {
  path: string[];
  pointer: string;
  kind: Kind;
  /** The parameter's name, as the specification's table has it. */
  name: string;
  meaning: Words;
  unit: string;
  symbol: string;
  source: string;
  /** Can be changed while a run goes on; undefined where the schema does not say. */
  live: boolean | undefined;
  nullable: boolean;
  required: boolean;
  /** Of a choice: all there are. Of a text: suggestions. */
  choices: Json[];
  /** Words for choices, by the choice. */
  labels: Record<string, Words>;
  minimum: number | undefined;
  maximum: number | undefined;
  exclusiveMinimum: number | undefined;
  exclusiveMaximum: number | undefined;
  /** Of a vector, a list or a matrix's rows. */
  minItems: number | undefined;
  maxItems: number | undefined;
  columns: number | undefined;
  pattern: string | undefined;
  default: Json | undefined;
  /** What the document says; undefined: the default applies. */
  value: Json | undefined;
}

/** An object of the document: its own fields, and the objects in it. */
export interface Section {
  path: string[];
  pointer: string;
  name: string;
  meaning: Words;
  fields: Field[];
  sections: Section[];
}

export function isSection(part: Field | Section): part is Section {
  return 'fields' in part;
}

/** The meaning in English (title, else description) and in Chinese (x-zh, else the English). Empty where the schema says none. */
function meaningOf(schema: Schema): Words {
  const en = schema.title ?? schema.description ?? '';
  const chinese = schema['x-zh'];
  return { en, zh: typeof chinese === 'string' && chinese !== '' ? chinese : en };
}

function numbers(value: Json | undefined): value is number[] {
  return Array.isArray(value) && value.every((item) => typeof item === 'number' || item === null);
}

function arrayKind(schema: Schema, value: Json | undefined, root: Schema): Kind {
  const sample = Array.isArray(value) ? value : Array.isArray(schema.default) ? schema.default : undefined;
  if (sample && sample.length > 0) {
    if (numbers(sample)) return 'vector';
    if (sample.every((row) => numbers(row))) return 'matrix';
    return sample.every((item) => typeof item === 'string') ? 'list' : 'json';
  }
  const item = typeof schema.items === 'object' ? resolve(schema.items, sample?.[0], root) : schema.prefixItems?.[0];
  const types = item ? typesOf(item) : [];
  if (types.includes('number') || types.includes('integer')) return 'vector';
  if (types.includes('string')) return 'list';
  if (item && types.includes('array') && arrayKind(item, undefined, root) === 'vector') return 'matrix';
  return 'json';
}

function kindOf(schema: Schema, value: Json | undefined, choices: Json[], root: Schema): Kind {
  if (schema.const !== undefined || schema.readOnly) return 'constant';
  if (choices.length > 0) return 'choice';
  const types = typesOf(schema).filter((type) => type !== 'null');
  const given = value ?? schema.default;
  if (types.length !== 1 && given !== undefined && given !== null) {
    if (typeof given === 'number') return types.includes('integer') && !types.includes('number') ? 'integer' : 'number';
    if (typeof given === 'boolean') return 'boolean';
    if (typeof given === 'string') return types.length === 0 || types.includes('string') ? 'text' : 'json';
    if (Array.isArray(given)) return arrayKind(schema, value, root);
    return 'json';
  }
  switch (types[0]) {
    case 'number': return 'number';
    case 'integer': return 'integer';
    case 'boolean': return 'boolean';
    case 'string': return 'text';
    case 'array': return arrayKind(schema, value, root);
    default: return 'json';
  }
}

function columnsOf(schema: Schema, value: Json | undefined, root: Schema): number | undefined {
  const item = typeof schema.items === 'object' ? resolve(schema.items, undefined, root) : undefined;
  if (item?.minItems !== undefined && item.minItems === item.maxItems) return item.minItems;
  const row = Array.isArray(value) ? value[0] : undefined;
  return Array.isArray(row) ? row.length : undefined;
}

/** Names to choose from where another text may stand as well: then the names are suggestions. */
function suggestionsOf(given: Schema, root: Schema): Json[] {
  const branches = (follow(given, root).anyOf ?? []).map((part) => follow(part, root));
  const isOpen = branches.some((part) => typesOf(part).includes('string') && !part.enum && part.const === undefined);
  return isOpen ? branches.flatMap((part) => part.enum ?? []) : [];
}

function labelsOf(schema: Schema): Record<string, Words> {
  const labels: Record<string, Words> = {};
  for (const [choice, words] of Object.entries(schema['x-labels'] ?? {})) {
    if (isObject(words) && typeof words.en === 'string') labels[choice] = { en: words.en, zh: typeof words.zh === 'string' ? words.zh : words.en };
  }
  return labels;
}

function makeField(given: Schema, path: string[], value: Json | undefined, root: Schema, required: boolean): Field {
  const schema = resolve(given, value, root);
  const suggestions = suggestionsOf(given, root);
  const choices = choicesOf(given, root).length > 0 ? choicesOf(given, root) : choicesOf(schema, root);
  const name = path.at(-1) ?? '';
  const kind = suggestions.length > 0 ? 'text' : kindOf(schema, value, choices, root);
  const range = kind === 'vector' && typeof schema.items === 'object' ? { ...follow(schema.items, root), ...schema } : schema;
  const fixed = kind === 'vector' && schema.prefixItems ? schema.prefixItems.length : undefined;
  return {
    path, pointer: pointer(path), kind, name,
    meaning: meaningOf({ ...schema, ...pickWords(follow(given, root)) }),
    unit: schema['x-unit'] ?? '',
    symbol: schema['x-symbol'] ?? '',
    source: schema['x-source'] ?? '',
    live: schema['x-live'],
    nullable: isNullable(given, root),
    required,
    choices: suggestions.length > 0 ? suggestions : choices,
    labels: labelsOf(schema),
    minimum: range.minimum, maximum: range.maximum,
    exclusiveMinimum: range.exclusiveMinimum, exclusiveMaximum: range.exclusiveMaximum,
    minItems: schema.minItems ?? fixed, maxItems: schema.maxItems ?? fixed,
    columns: kind === 'matrix' ? columnsOf(schema, value ?? schema.default, root) : undefined,
    pattern: suggestions.length > 0 ? undefined : schema.pattern,
    default: schema.default,
    value,
  };
}

/** The words of the member itself win over those of the branch that was chosen for it. */
function pickWords(schema: Schema): Schema {
  const own: Schema = {};
  if (schema.title !== undefined) own.title = schema.title;
  if (schema.description !== undefined) own.description = schema.description;
  if (schema['x-zh'] !== undefined) own['x-zh'] = schema['x-zh'];
  return own;
}

function memberSchema(schema: Schema, key: string): Schema | undefined {
  const named = schema.properties?.[key];
  if (named) return named;
  for (const [pattern, part] of Object.entries(schema.patternProperties ?? {})) {
    if (new RegExp(pattern, 'u').test(key)) return part;
  }
  return typeof schema.additionalProperties === 'object' ? schema.additionalProperties : undefined;
}

function isObjectLike(schema: Schema, value: Json | undefined): boolean {
  if (isObject(value)) return true;
  if (value !== undefined && value !== null) return false;
  const types = typesOf(schema).filter((type) => type !== 'null');
  return types.length === 1 && types[0] === 'object' && value !== null;
}

/**
 * The form's view of one object. Members come in the schema's order, then those that only the document has; objects become
 * sections, all else fields.
 */
export function makeSection(given: Schema, path: string[], value: Json | undefined, root: Schema): Section {
  const schema = resolve(given, value ?? {}, root);
  const name = path.at(-1) ?? '';
  const held = isObject(value) ? value : {};
  const isMap = typeof schema.additionalProperties === 'object' || schema.patternProperties !== undefined;
  const declared = Object.keys(schema.properties ?? {}).filter((key) => !isMap || Object.hasOwn(held, key));
  const extra = Object.keys(held).filter((key) => !declared.includes(key));
  const keys = isMap ? Object.keys(held) : [...declared, ...extra];
  const section: Section = { path, pointer: pointer(path), name, meaning: meaningOf(schema), fields: [], sections: [] };
  for (const key of keys) {
    const member = memberSchema(schema, key) ?? {};
    const here = [...path, key];
    if (isObjectLike(resolve(member, held[key], root), held[key])) {
      section.sections.push(makeSection(member, here, held[key], root));
    } else {
      section.fields.push(makeField(member, here, held[key], root, schema.required?.includes(key) ?? false));
    }
  }
  return section;
}

/** Every field of a section and of those in it, in the order they are shown. */
export function fieldsOf(section: Section): Field[] {
  return [...section.fields, ...section.sections.flatMap(fieldsOf)];
}
