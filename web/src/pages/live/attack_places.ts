/// Where an attack that is started by hand can act, and which attacks act there.
import type { RunDetail } from '../../api/types';
import type { AttackKind } from './hands/kinds';
import type { RunModel } from './model';

export const placeKinds = ['link', 'actuator', 'sensor'] as const;
export type PlaceKind = (typeof placeKinds)[number];

type Places = Pick<RunModel, 'links' | 'nodes'>;

const usual: Readonly<Record<PlaceKind, string>> = { link: 'dos_fdi', sensor: 'replay', actuator: 'bias' };

/** The words on the button. */
export const titles = { link: 'attack', sensor: 'attack_sensor', actuator: 'attack_actuator' } as const satisfies Record<PlaceKind, string>;

/** Parameters that say when an attack acts: by hand it acts from now on, for as long as the dialog says. */
const schedules: Readonly<Record<string, readonly string[]>> = { replay: ['case', 'start', 'end'] };

export function setByHand(type: string, parameter: string): boolean {
  return !schedules[type]?.includes(parameter);
}

/** Of the types of a schema those that act on such places; one that the registry does not list may act anywhere. */
export function typesAt(types: readonly string[], kind: PlaceKind, known: readonly AttackKind[]): string[] {
  return types.filter((type) => known.find(({ id }) => id === type)?.actsOn.includes(kind) ?? true);
}

export function placesOf(model: Places | null, kind: PlaceKind): string[] {
  if (kind === 'link') return model?.links.map((link) => link.id) ?? [];
  return model?.nodes.flatMap((node) => ((kind === 'sensor' ? node.state !== null : node.actuator) ? [node.id] : [])) ?? [];
}

type Attacks = Record<string, { type?: unknown; on?: unknown } | null>;

function actsOn(attack: Attacks[string], kind: PlaceKind): boolean {
  return Array.isArray(attack?.on) && attack.on.some((place) => String(place).startsWith(`${kind}:`));
}

/** What the scenario's own adversary acts on; where it has none, links before actuators before sensors: what detectors listen to comes before what moves the plant. */
export function usualKind(run: (Pick<RunDetail, 'document'> & Partial<Pick<RunDetail, 'family' | 'view'>>) | null, model: Places | null): PlaceKind {
  const attacks = Object.values((run?.document?.adversary ?? {}) as Attacks);
  const own = placeKinds.find((kind) => attacks.some((attack) => actsOn(attack, kind)));
  if (own && placesOf(model, own).length) return own;
  const detects = run?.family === 'replay' || run?.view?.detector === true;
  const order: readonly PlaceKind[] = detects ? ['link', 'sensor', 'actuator'] : placeKinds;
  return order.find((kind) => placesOf(model, kind).length) ?? 'link';
}

/** Of the types that act on such places the one that the scenario makes there itself, else the usual one. */
export function usualType(run: Pick<RunDetail, 'document'> | null, types: readonly string[], kind: PlaceKind): string {
  const own = Object.values((run?.document?.adversary ?? {}) as Attacks).find((attack) => actsOn(attack, kind) && types.includes(String(attack?.type)));
  // Pieces of time are a scenario's: by hand a push that lasts is meant. Who only listens in the scenario listens by hand, too.
  const wanted = kind === 'sensor' || own?.type === 'eavesdrop' ? String(own?.type ?? usual[kind]) : usual[kind];
  return types.includes(wanted) ? wanted : (types[0] ?? '');
}
