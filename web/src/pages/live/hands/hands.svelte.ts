/// What a hand is about to do: the menu at a place that was taken, and what the attack dialog is to begin with.
import type { RunDetail, Signal } from '../../../api/types';
import { placesOf, type PlaceKind } from '../attack_places';
import type { RunModel } from '../model';

export interface Menu {
  /** "link:1-2" or "node:3". */
  target: string;
  /** In the window, px. */
  x: number;
  y: number;
  /** What gets the focus back. */
  origin: HTMLElement | null;
}

export interface Wish {
  kind: PlaceKind;
  place: string;
  type: string;
  /** Why it could not begin at once. */
  failure: string;
}

export class Hands {
  menu = $state.raw<Menu | null>(null);
  wish = $state.raw<Wish | null>(null);
  /** The attack whose time is being changed. */
  moving = $state.raw<string | null>(null);
}

export interface Place {
  kind: PlaceKind;
  id: string;
  /** As an attack names it: "sensor:3". */
  on: string;
}

/** The places of a target that attacks can act on. */
export function placesAt(model: RunModel, target: string): Place[] {
  const id = target.slice(target.indexOf(':') + 1);
  const kinds: readonly PlaceKind[] = target.startsWith('link:') ? ['link'] : ['sensor', 'actuator'];
  return kinds.filter((kind) => placesOf(model, kind).includes(id)).map((kind) => ({ kind, id, on: `${kind}:${id}` }));
}

/** Everything that a hand can take: links, then nodes with a sensor or an actuator that can be attacked. */
export function targetsOf(model: RunModel): string[] {
  const links = model.links.map(({ id }) => `link:${id}`);
  const nodes = model.nodes.map(({ id }) => `node:${id}`).filter((target) => placesAt(model, target).length);
  return [...links, ...nodes];
}

/** How many numbers an attack there meets: components of a message, channels of a reading or of an actuator. */
export function sizeAt(run: Pick<RunDetail, 'world'>, signals: readonly Signal[], { kind, id }: Place): number {
  if (kind === 'link') return run.world?.state?.length ?? 0;
  const pattern = kind === 'sensor' ? /^[^.]+$/ : /^[^.]+\.injected$/;
  const prefix = `${kind}.${id}.`;
  return signals.filter(({ name }) => name.startsWith(prefix) && name !== `${prefix}state` && pattern.test(name.slice(prefix.length))).length;
}
