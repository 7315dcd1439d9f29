/// The run that a figure is of: started at full speed, or opened where this server has made it before.
import { api, freshKey } from '../../api/client';
import type { PaperItem } from '../../api/papers';
import { ApiProblem } from '../../api/problem';
import type { NewRun } from '../../api/types';
import type { JsonObject } from '../../form/json';
import { writePatch } from '../../form/share';

type Place = Pick<PaperItem, 'key' | 'scenes'>;

export function orderOf({ key, scenes }: Place, index: number, seed: number): NewRun {
  const { name, scenario, patch } = scenes[index]!;
  return { scenario, patch, seed, pace: 'max', tags: ['papers', key], note: `${key}: ${name.en}` };
}

/** The same for the same run of the same version, so that the server gives the one that it has. */
export const keyOf = (key: string, index: number, seed: number, version: string): string => `papers ${key} ${index} seed ${seed} version ${version}`;

/** The run's id. */
export async function openScene(item: Place, index: number, seed: number): Promise<string> {
  const order = orderOf(item, index, seed);
  const { version } = await api.server();
  try {
    return (await api.start(order, keyOf(item.key, index, seed, version))).id;
  } catch (error) {
    // It was deleted, or the item's run is another one now.
    if (!(error instanceof ApiProblem) || (error.status !== 404 && error.status !== 422)) throw error;
    return (await api.start(order, freshKey())).id;
  }
}

/** The form of the scenario with the same changes. */
export function formOf({ scenes }: Place, index: number, seed: number): string {
  const { scenario, patch } = scenes[index]!;
  const query = new URLSearchParams();
  const text = writePatch(patch as JsonObject);
  if (text !== null) query.set('patch', text);
  if (seed !== 1) query.set('seed', String(seed));
  return `/scenarios/${encodeURIComponent(scenario)}${query.size ? `?${query}` : ''}`;
}
