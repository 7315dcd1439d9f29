/// Names of states, inputs and channels: given in the document, or by their number.
import type { JsonObject } from '../../../form/json';
import { at, put } from '../../../form/pointer';
import { nodesOf, outputsOf, sensorPath, sizesOf, type Path } from './places';

export const namePaths = { states: ['plant', 'params', 'states'], inputs: ['plant', 'params', 'inputs'] } as const;
export const channelPath = (id: string): string[] => [...sensorPath(id), 'channels'];

function listed(document: JsonObject, path: Path, count: number, letter: string): string[] {
  const given = at(document, path);
  return Array.from({ length: count }, (_, i) => (Array.isArray(given) && typeof given[i] === 'string' && given[i] ? given[i] : `${letter}${i + 1}`));
}

export const stateNames = (document: JsonObject): string[] => listed(document, namePaths.states, sizesOf(document).n, 'x');
export const inputNames = (document: JsonObject): string[] => listed(document, namePaths.inputs, sizesOf(document).m, 'u');
export const channelNames = (document: JsonObject, id: string): string[] => listed(document, channelPath(id), outputsOf(document, id), 'y');

/** Whether names are given, not counted. */
export const named = (document: JsonObject, path: Path): boolean => Array.isArray(at(document, path));

/** Names as typed, apart by commas or blanks; none: counted again. */
export function setNames(document: JsonObject, path: Path, text: string): JsonObject {
  const names = text.split(/[\s,，、]+/).filter((name) => name !== '');
  return put(document, path, names.length ? names : undefined);
}

/** Where names are given they are as many as what they name. */
export function withNames(document: JsonObject): JsonObject {
  let next = document;
  const fit = (path: Path, names: string[]): void => {
    const given = at(next, path);
    if (Array.isArray(given) && given.length !== names.length) next = put(next, path, names.length ? names : undefined);
  };
  fit(namePaths.states, stateNames(next));
  fit(namePaths.inputs, inputNames(next));
  for (const id of nodesOf(next)) fit(channelPath(id), channelNames(next, id));
  return next;
}
