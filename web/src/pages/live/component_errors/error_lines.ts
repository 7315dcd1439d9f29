/// Signed errors of single components, node by node: estimate minus truth (seed 001, figures 4 and 5).
import type { LineSpec } from '../lines';
import { laneWord, type LaneModel, type RunModel } from '../model';
import { lookOf } from '../space/space_model';

/** Errors within the sensors' noise (standard deviation 0.01) are drawn linearly, larger ones logarithmically. */
export const linearWithin = 0.01;

/** The method that uses no sensor: the honest reference of every error. */
const referenceMethod = 'dead_reckoning';

export function referenceLane(model: RunModel): LaneModel | null {
  return model.lanes.find((lane) => lane.method === referenceMethod) ?? null;
}

export interface ErrorLines {
  component: string;
  unit: string;
  lines: LineSpec[];
  /** Whether the reference is among the lines. */
  reference: boolean;
}

/** For each component one line a node of the lane, and under them the reference, thin; components that nobody estimates are left out. */
export function errorLines(model: RunModel, lane: LaneModel, components: readonly string[], node: string | null): ErrorLines[] {
  const known = new Map(model.signals.map((signal) => [signal.name, signal]));
  const reference = referenceLane(model);
  return components.flatMap((component) => {
    const minus = `truth.${component}`;
    const truth = known.get(minus);
    if (!truth) return [];
    const lines = lane.outputs.flatMap((id): LineSpec[] => {
      const signal = `lane.${lane.id}.${id}.estimate.${component}`;
      const { token, dash } = lookOf(model, id);
      return known.has(signal) ? [{ key: signal, name: id, signal, minus, token, dash, width: id === node ? 2.2 : 1.5, strong: id === node }] : [];
    });
    if (!lines.length) return [];
    const under = reference && reference !== lane ? referenceLine(reference, component, minus, known) : null;
    return [{ component, unit: truth.unit, lines: under ? [under, ...lines] : lines, reference: under !== null }];
  });
}

/** One of its nodes is enough: without sensors all are the same. */
function referenceLine(lane: LaneModel, component: string, minus: string, known: ReadonlyMap<string, unknown>): LineSpec | null {
  const signal = lane.outputs.map((id) => `lane.${lane.id}.${id}.estimate.${component}`).find((name) => known.has(name));
  return signal ? { key: signal, name: laneWord(lane.id), signal, minus, token: 'muted', dash: [], width: 0.9, unstreamed: true } : null;
}
