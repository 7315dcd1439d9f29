/// What the catalogue offers of a lane whose nodes choose whose estimate they take (seed 001, eq. (7) to (9)).
import type { Signal } from '../../../api/types';
import { laneOf, type LaneModel, type RunModel } from '../model';

export interface Candidate {
  /** Node id. */
  id: string;
  utility: string | null;
  probability: string | null;
}

export interface Chooser {
  id: string;
  choice: string;
  candidates: Candidate[];
}

export interface Game {
  lane: LaneModel;
  /** One a node that chooses, in the order of the document. */
  choosers: Chooser[];
  /** Node id of a value of `choice`. */
  nodes: string[];
}

/** The chosen lane's game; where it has none, that of the first lane that has one. */
export function gameOf(model: RunModel, lane: string | null): Game | null {
  const chosen = laneOf(model, lane);
  for (const one of [...(chosen ? [chosen] : []), ...model.lanes]) {
    const game = readGame(model, one);
    if (game) return game;
  }
  return null;
}

function readGame(model: RunModel, lane: LaneModel): Game | null {
  const names = new Map(model.signals.map((signal) => [signal.name, signal]));
  const known = model.nodes.map((node) => node.id);
  const choosers: Chooser[] = [];
  let nodes = known;
  for (const id of lane.outputs) {
    const prefix = `lane.${lane.id}.${id}.`;
    const choice = names.get(`${prefix}choice`);
    if (!choice) continue;
    nodes = labelled(choice, known);
    const candidates = nodes
      .map((other): Candidate => ({ id: other, utility: named(names, `${prefix}utility.${other}`), probability: named(names, `${prefix}probability.${other}`) }))
      .filter((candidate) => candidate.probability !== null);
    choosers.push({ id, choice: choice.name, candidates });
  }
  return choosers.length ? { lane, choosers, nodes } : null;
}

/** Values are indices of nodes; the catalogue's labels say which. */
function labelled(choice: Signal, known: string[]): string[] {
  const values = Object.keys(choice.labels ?? {}).map(Number);
  if (!values.length) return known;
  return Array.from({ length: Math.max(...values) + 1 }, (_, value) => choice.labels![String(value)] ?? '');
}

function named(names: ReadonlyMap<string, Signal>, name: string): string | null {
  return names.has(name) ? name : null;
}
