/// What a run with a fusion centre tells of every lane: whose estimates there are, and the signals of each.
import type { RunDetail } from '../../../api/types';
import type { LaneModel, RunModel } from '../model';

/** Who has an estimate: the legitimate user, one who fused the local estimates themselves, a node, or one who listens. */
export type Role = 'fused' | 'optimal' | 'local' | 'sent' | 'compensated' | 'eve';

export interface Curve {
  /** What is shown and hidden together: the role, or "eve.<variant>" of whom a mechanism is meant against, "other.<variant>" of the others. */
  id: string;
  role: Role;
  /** Of local, sent and compensated values. */
  node: string | null;
  variant: string | null;
  /** Signals: squared error over the whole state, trace of the covariance; null: not told. */
  square: string | null;
  trace: string | null;
  /** Signal of one state component, up to the component's name. */
  estimate: string;
}

const sets = new WeakMap<RunModel, Set<string>>();

/** Names of all signals of a run. */
export function namesOf(model: RunModel): Set<string> {
  let set = sets.get(model);
  if (!set) sets.set(model, (set = new Set(model.signals.map(({ name }) => name))));
  return set;
}

export function known(model: RunModel, name: string): string | null {
  return namesOf(model).has(name) ? name : null;
}

export function squareOf(model: RunModel, lane: Pick<LaneModel, 'id'>): string | null {
  return known(model, `lane.${lane.id}.fused.square`);
}

/** Whether some lane has a fusion centre whose errors are told. */
export function hasCentre(model: RunModel): boolean {
  return model.lanes.some((lane) => squareOf(model, lane) !== null);
}

/** Eavesdroppers of a lane in the catalogue's order; the first is the one its mechanism is meant against. */
export function variantsOf(model: RunModel, lane: Pick<LaneModel, 'id'>): string[] {
  const head = `lane.${lane.id}.eve.`;
  const found = new Set<string>();
  for (const { name } of model.signals) if (name.startsWith(head)) found.add(name.slice(head.length).split('.')[0]!);
  return [...found];
}

function curve(model: RunModel, lane: string, id: string, role: Role, output: string, node: string | null, names = { square: 'square', trace: 'trace', estimate: 'estimate' }): Curve {
  const head = `lane.${lane}.${output}.`;
  return { id, role, node, variant: role === 'eve' ? output.slice('eve.'.length) : null, square: known(model, head + names.square), trace: known(model, head + names.trace), estimate: `${head}${names.estimate}.` };
}

/** All whose estimates a lane tells, the legitimate user first. */
export function curvesOf(model: RunModel, lane: Pick<LaneModel, 'id'>): Curve[] {
  const of = (role: Role, output: string, node: string | null = null, names?: { square: string; trace: string; estimate: string }): Curve => curve(model, lane.id, role, role, output, node, names);
  const kinds = [
    ['local', { square: 'square', trace: 'trace', estimate: 'estimate' }],
    ['sent', { square: 'sent_square', trace: '', estimate: 'sent' }],
    ['compensated', { square: 'compensated_square', trace: 'compensated_trace', estimate: 'compensated' }],
  ] as const;
  const nodes = kinds.flatMap(([role, names]) => model.nodes.map(({ id }) => of(role, id, id, names)));
  const all = [of('fused', 'fused'), of('optimal', 'optimal'), ...nodes, ...variantsOf(model, lane).map((variant, i) => curve(model, lane.id, `${i ? 'other' : 'eve'}.${variant}`, 'eve', `eve.${variant}`, null))];
  return all.filter(({ square, estimate }) => square !== null || model.signals.some(({ name }) => name.startsWith(estimate)));
}

/** What is not drawn until it is asked for. */
const quiet: readonly string[] = ['local', 'sent', 'other.fusing', 'other.differencing', 'other.zero'];

/** Whether a curve is drawn; `turned` are those that were switched from how they begin. */
export function isShown(turned: readonly string[], id: string): boolean {
  return quiet.includes(id) === turned.includes(id);
}

/** The two components that are a place in the plane, null where the state has none. */
export function planeOf(run: Pick<RunDetail, 'view'> | null, model: RunModel): [string, string] | null {
  const pairs = [run?.view?.plane?.components, ['sx', 'sy'], ['x', 'y']];
  const found = pairs.find((pair) => pair?.every((component) => known(model, `truth.${component}`)));
  return found ? [found[0]!, found[1]!] : null;
}

/** Components of the true state, those that are positions first. */
export function componentsOf(model: RunModel): { name: string; unit: string }[] {
  const all = model.signals.filter(({ name }) => name.startsWith('truth.')).map(({ name, unit }) => ({ name: name.slice('truth.'.length), unit }));
  const position = ({ name }: { name: string }): boolean => /^(position|[sp]?[xyz])$/i.test(name);
  return [...all.filter(position), ...all.filter((one) => !position(one))];
}

/** How a lane's messages are protected, as the document says; "none" where they are not. */
export function protectionOf(run: Pick<RunDetail, 'document'> | null, lane: string): string {
  const own = (run?.document?.lanes as Record<string, { protection?: { type?: unknown } } | undefined> | undefined)?.[lane];
  return typeof own?.protection?.type === 'string' ? own.protection.type : 'none';
}
