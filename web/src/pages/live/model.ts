/// What a run's catalogue and world offer to the panels. Names follow the contract; nothing is assumed to be there.
import type { RunDetail, Signal } from '../../api/types';
import { laneDash, laneToken } from '../../chart/colours';

export interface LaneModel {
  id: string;
  method: string;
  /** Whether the adversary touches it. */
  adversary: boolean;
  token: string;
  dash: number[];
  /** Output ids in catalogue order: nodes, or "fused". */
  outputs: string[];
  rmse: string | null;
  /** Signal names by output id. */
  error: Map<string, string>;
  bound: Map<string, string>;
  lost: Map<string, string>;
  feasible28: Map<string, string>;
  feasible29: Map<string, string>;
  /** Signals of the plane's two components by output id. */
  estimate: Map<string, [string, string]>;
}

export interface LinkModel {
  id: string;
  from: string;
  to: string;
  state: string | null;
}

export interface RunModel {
  lanes: LaneModel[];
  links: LinkModel[];
  /** `state`: the signal that tells which attack acts on the node's sensor. `actuator`: whether it has one that can be attacked. */
  nodes: { id: string; position: [number, number] | null; state: string | null; actuator?: boolean }[];
  /** Who is not a node and receives from nodes: a fusion centre. Null: there is none. */
  centre: string | null;
  plane: { x: string; y: string; unit: string } | null;
  errorUnit: string;
  /** The lane that a scenario leads with. */
  lead: string | null;
  signals: Signal[];
}

const perNode = ['error', 'bound', 'lost', 'feasible28', 'feasible29'] as const;

export function makeModel(run: RunDetail, signals: Signal[]): RunModel {
  const names = new Map(signals.map((signal) => [signal.name, signal]));
  const [cx, cy] = planeComponents(run, names);
  const lanes = laneIds(run, signals).map((lane, index) => makeLane(lane, index, signals, names, cx, cy));
  const plane = cx && names.has(`truth.${cx}`) && names.has(`truth.${cy}`) ? { x: `truth.${cx}`, y: `truth.${cy}`, unit: run.view?.plane?.unit ?? names.get(`truth.${cx}`)!.unit } : null;
  const anyError = signals.find((signal) => signal.lane && signal.name.endsWith('.error'));
  return {
    lanes,
    links: (run.world?.links ?? []).map(({ id, from, to }) => ({ id, from, to, state: names.has(`link.${id}.state`) ? `link.${id}.state` : null })),
    nodes: (run.world?.nodes ?? []).map(({ id, position }) => ({ id, position: position && position.length >= 2 ? [position[0]!, position[1]!] : null, state: names.has(`sensor.${id}.state`) ? `sensor.${id}.state` : null, ...(signals.some(({ name }) => name.startsWith(`actuator.${id}.`)) ? { actuator: true } : {}) })),
    centre: centreOf(run),
    plane,
    errorUnit: run.view?.error_unit ?? anyError?.unit ?? '',
    lead: run.view?.lane ?? null,
    signals,
  };
}

function centreOf(run: RunDetail): string | null {
  const nodes = run.world?.nodes ?? [];
  return (run.world?.links ?? []).find(({ to }) => nodes.length > 0 && !nodes.some(({ id }) => id === to))?.to ?? null;
}

function planeComponents(run: RunDetail, names: Map<string, Signal>): [string, string] {
  const hint = run.view?.plane?.components;
  if (hint) return hint;
  return names.has('truth.x') && names.has('truth.y') ? ['x', 'y'] : ['', ''];
}

/** Lanes in document order; a lane that only the frames know (computed elsewhere) comes after them. */
function laneIds(run: RunDetail, signals: Signal[]): { id: string; method: string; adversary: boolean }[] {
  const lanes = [...(run.world?.lanes ?? [])];
  for (const signal of signals) {
    if (signal.lane && !lanes.some((lane) => lane.id === signal.lane)) lanes.push({ id: signal.lane, method: '', adversary: true });
  }
  return lanes;
}

function makeLane(lane: { id: string; method: string; adversary: boolean }, index: number, signals: Signal[], names: Map<string, Signal>, cx: string, cy: string): LaneModel {
  const model: LaneModel = {
    ...lane,
    token: laneToken(index),
    dash: laneDash(index),
    outputs: [],
    rmse: names.has(`lane.${lane.id}.rmse`) ? `lane.${lane.id}.rmse` : null,
    error: new Map(),
    bound: new Map(),
    lost: new Map(),
    feasible28: new Map(),
    feasible29: new Map(),
    estimate: new Map(),
  };
  const outputs = new Set<string>();
  for (const signal of signals) if (signal.lane === lane.id && signal.node) outputs.add(signal.node);
  for (const output of outputs) {
    const prefix = `lane.${lane.id}.${output}.`;
    for (const kind of perNode) if (names.has(prefix + kind)) model[kind].set(output, prefix + kind);
    const x = `${prefix}estimate.${cx}`;
    const y = `${prefix}estimate.${cy}`;
    if (names.has(x) && names.has(y)) model.estimate.set(output, [x, y]);
  }
  model.outputs = [...outputs];
  return model;
}

export function laneOf(model: RunModel, id: string | null): LaneModel | null {
  const find = (wanted: string | null): LaneModel | undefined => model.lanes.find((lane) => lane.id === wanted);
  return find(id) ?? find(model.lead) ?? model.lanes[0] ?? null;
}

/** A lane's id as a person reads it: naive_hold -> naive hold. */
export function laneWord(id: string): string {
  return id.replaceAll('_', ' ');
}
