import { makeSection, fieldsOf, type Field, type Section } from './fields';
import { copy, isObject, type Json, type JsonObject } from './json';
import { at, put } from './pointer';
import { diff, isExact } from './patch';
import { constantsOf, resolve, type Schema } from './schema';

export const kGroups = ['time', 'plant', 'network', 'adversary', 'lanes', 'noise', 'log'] as const;
export type GroupId = (typeof kGroups)[number];

/** Which members of the document each group shows. */
const kMembers: Record<GroupId, readonly string[]> = {
  time: ['time'],
  plant: ['plant', 'controller', 'initial'],
  network: ['network', 'nodes'],
  adversary: ['adversary'],
  lanes: ['lanes'],
  noise: ['noise'],
  log: ['log', 'metrics', 'reproducible'],
};

export interface Group {
  id: GroupId;
  /** Members that are objects. */
  sections: Section[];
  /** Members that are plain values. */
  fields: Field[];
}

/** The whole form for a document: groups in reading order; a group without content is left out, lanes and adversary stay. */
export function makeGroups(schema: Schema, document: JsonObject): Group[] {
  const whole = makeSection(schema, [], document, schema);
  const groups = kGroups.map((id) => ({
    id,
    sections: whole.sections.filter((section) => kMembers[id].includes(section.name)),
    fields: whole.fields.filter((field) => kMembers[id].includes(field.name)),
  }));
  return groups.filter(({ id, sections, fields }) => {
    return id === 'lanes' || id === 'adversary' || fields.length > 0 || sections.some((section) => fieldsOf(section).length > 0);
  });
}

export function allFields(groups: readonly Group[]): Field[] {
  return groups.flatMap((group) => [...group.fields, ...group.sections.flatMap(fieldsOf)]);
}

export function set(document: JsonObject, path: readonly string[], value: Json | undefined): JsonObject {
  return put(document, path, value);
}

/** An id that the map does not have yet: the wanted one, or with _2, _3, … behind it. Ids are [a-z0-9_]{1,32}. */
export function freeId(map: JsonObject, wanted: string): string {
  if (!Object.hasOwn(map, wanted)) return wanted;
  const stem = wanted.replace(/_\d+$/, '').slice(0, 28);
  for (let n = 2; ; n += 1) if (!Object.hasOwn(map, `${stem}_${n}`)) return `${stem}_${n}`;
}

function mapAt(document: JsonObject, key: string): JsonObject {
  const map = document[key];
  return isObject(map) ? map : {};
}

/** The schema of a new member of a map such as lanes or adversary. */
function memberSchema(schema: Schema, key: string): Schema {
  const map = resolve(schema.properties?.[key] ?? {}, {}, schema);
  if (typeof map.additionalProperties === 'object') return map.additionalProperties;
  const pattern = Object.values(map.patternProperties ?? {})[0];
  return pattern ?? Object.values(map.properties ?? {})[0] ?? {};
}

/** The methods a lane can have, in the schema's order. */
export function methodsOf(schema: Schema): string[] {
  return constantsOf(memberSchema(schema, 'lanes'), 'method', schema);
}

/** The attacks that the schema knows. */
export function attackTypesOf(schema: Schema): string[] {
  return constantsOf(memberSchema(schema, 'adversary'), 'type', schema);
}

export function addLane(document: JsonObject, method: string): { document: JsonObject; id: string } {
  const id = freeId(mapAt(document, 'lanes'), method);
  return { document: put(document, ['lanes', id], { method, params: {} }), id };
}

export function addAttack(document: JsonObject, type: string): { document: JsonObject; id: string } {
  const id = freeId(mapAt(document, 'adversary'), type);
  return { document: put(document, ['adversary', id], { type, params: {} }), id };
}

export function duplicate(document: JsonObject, map: 'lanes' | 'adversary', id: string): { document: JsonObject; id: string } {
  const member = at(document, [map, id]);
  const made = freeId(mapAt(document, map), id);
  return { document: put(document, [map, made], copy(member ?? {})), id: made };
}

export function remove(document: JsonObject, map: 'lanes' | 'adversary', id: string): JsonObject {
  return put(document, [map, id], undefined);
}

/** Another method for a lane: the old one's parameters mean nothing to it, so they go back to the new one's defaults. */
export function setMethod(document: JsonObject, lane: string, method: string): JsonObject {
  return put(put(document, ['lanes', lane, 'method'], method), ['lanes', lane, 'params'], {});
}

export function setAttackType(document: JsonObject, attack: string, type: string): JsonObject {
  return put(put(document, ['adversary', attack, 'type'], type), ['adversary', attack, 'params'], {});
}

/** What POST /runs needs to say to get this document: the preset's id and a patch, or the whole where a patch cannot. */
export type Start = { scenario: string; patch: JsonObject } | { scenario: JsonObject };

export function startOf(id: string, preset: JsonObject, document: JsonObject, schema: Schema): Start {
  const fields = new Map(allFields(makeGroups(schema, document)).map((field) => [field.pointer, field.default]));
  const defaultAt = (path: string[]): Json | undefined => fields.get('/' + path.join('/'));
  if (!isExact(preset, document, defaultAt)) return { scenario: document };
  return { scenario: id, patch: diff(preset, document) };
}
