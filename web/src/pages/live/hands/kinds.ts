/// The attacks that the server knows, and the places each acts on, as GET /methods tells them.
import { api } from '../../../api/client';
import { askCompatibility, type Row } from '../../../api/compatibility';
import type { Localised, RunDetail } from '../../../api/types';
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

const examples = new Map<string, Promise<readonly Row[]>>();

/** Recorded input and gains belong to a run, not to its document: without them the server cannot judge that. */
export function judgedByDocument({ input, design }: Pick<RunDetail, 'input' | 'design'>): boolean {
  return input === 'simulate' && !Object.values(design ?? {}).some((one) => 'solver' in one);
}

/** What the server says of a run's attacks on its kinds of places, with an example of each. Empty where it cannot say. */
export function examplesOf(run: Pick<RunDetail, 'id' | 'document' | 'input' | 'design'>): Promise<readonly Row[]> {
  if (!judgedByDocument(run)) return Promise.resolve([]);
  const known = examples.get(run.id) ?? askCompatibility(run.document).then(({ rows }) => rows, () => []);
  examples.set(run.id, known);
  return known;
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

/** An example's parameters for a place that may take vectors of another size: its last entry goes on. */
export function resized(params: Readonly<Record<string, unknown>>, size: number): Record<string, unknown> {
  const fit = (value: unknown): unknown => {
    if (size < 1 || !Array.isArray(value) || !value.length || !value.every((one) => typeof one === 'number')) return value;
    return Array.from({ length: size }, (_, i) => value[Math.min(i, value.length - 1)] as number);
  };
  return Object.fromEntries(Object.entries(params).map(([name, value]) => [name, fit(value)]));
}
