/// The attacks that the server knows, and the places each acts on, as GET /methods tells them.
import { api } from '../../../api/client';
import type { Localised } from '../../../api/types';
import { placeKinds, type PlaceKind } from '../attack_places';

interface AttackParameter {
  name: string;
  type: string;
  default: unknown;
  required: boolean;
}

export interface AttackKind {
  id: string;
  title: Localised;
  actsOn: readonly PlaceKind[];
  parameters: readonly AttackParameter[];
}

interface Told {
  id: string;
  title: Localised;
  acts_on?: readonly string[];
  parameters?: readonly AttackParameter[];
}

/** What does not say where it acts may act anywhere: the server refuses with the reason. */
export function kindsOf(methods: unknown): AttackKind[] {
  const attacks = (methods as { attacks?: readonly Told[] } | null)?.attacks ?? [];
  return attacks.map(({ id, title, acts_on, parameters }) => ({
    id,
    title,
    actsOn: acts_on ? placeKinds.filter((kind) => acts_on.includes(kind)) : placeKinds,
    parameters: parameters ?? [],
  }));
}

let asked: Promise<AttackKind[]> | null = null;

/** Asked for once; a question that failed is asked again. */
export function attackKinds(): Promise<AttackKind[]> {
  asked ??= api.methods().then(kindsOf).catch((error: unknown) => {
    asked = null;
    throw error;
  });
  return asked;
}

/** Whether it can begin without a word: nothing that it needs is without a default. */
export function beginsAtOnce(kind: AttackKind): boolean {
  return kind.parameters.every(({ required, default: usual }) => !required || usual !== null);
}

/** Parameters that differ from the defaults because a default vector has another size than what is attacked: cut, or filled up with zeros. */
export function fittingParams(kind: AttackKind, size: number): Record<string, unknown> {
  const params: Record<string, unknown> = {};
  for (const { name, type, default: usual } of kind.parameters) {
    if (type !== 'vector' || !Array.isArray(usual) || size < 1 || usual.length === size) continue;
    params[name] = Array.from({ length: size }, (_, i) => Number(usual[i] ?? 0));
  }
  return params;
}
