/// Which lanes detect, and what their signals are called.
import type { RunDetail } from '../../../api/types';
import { laneOf, type LaneModel, type RunModel } from '../model';

export interface Detector {
  lane: LaneModel;
  node: string;
  statistic: string;
  threshold: string;
  alarm: string;
  /** Tells whether what the lane reads is attacked; null: it never is. */
  state: string | null;
}

/** Runs that are about detectors, by their family or by a hint of their scenario. */
export function aboutDetectors(run: Pick<RunDetail, 'family' | 'view'>): boolean {
  return run.family === 'replay' || run.view?.detector === true;
}

/** One a lane, in the order of the document: of the chosen node, or of the first that has one. */
export function detectorsOf(model: RunModel, node: string | null): Detector[] {
  const names = new Set(model.signals.map((signal) => signal.name));
  const has = (lane: LaneModel, output: string): boolean => ['statistic', 'threshold', 'alarm'].every((kind) => names.has(`lane.${lane.id}.${output}.${kind}`));
  const told = model.nodes.find(({ id, state }) => state !== null && id === node) ?? model.nodes.find(({ state }) => state !== null);
  // One filter over all sensors hears every node: it is judged by the chosen one's state, or by the first's.
  const stateOf = (lane: LaneModel, output: string): string | null => {
    const own = model.nodes.some(({ id }) => id === output);
    return attackState(names, lane, own ? output : (told?.id ?? output));
  };
  return model.lanes.flatMap((lane) => {
    const outputs = lane.outputs.filter((output) => has(lane, output));
    const output = outputs.find((one) => one === node) ?? outputs[0];
    if (output === undefined) return [];
    const prefix = `lane.${lane.id}.${output}.`;
    return [{ lane, node: output, statistic: `${prefix}statistic`, threshold: `${prefix}threshold`, alarm: `${prefix}alarm`, state: stateOf(lane, output) }];
  });
}

/** The signal that tells whether what a lane reads of a node is attacked; null: it never is, or nobody tells. */
export function attackState(names: ReadonlySet<string>, lane: LaneModel, node: string): string | null {
  const states = [`lane.${lane.id}.sensor.${node}.state`, ...(lane.adversary ? [`sensor.${node}.state`] : [])];
  return states.find((name) => names.has(name)) ?? null;
}

/** The chosen lane's detector; where it has none that of the lane that the scenario leads with, or the first. */
export function detectorOf(model: RunModel, laneId: string | null, node: string | null): Detector | null {
  const all = detectorsOf(model, node);
  const chosen = laneOf(model, laneId);
  return all.find(({ lane }) => lane === chosen) ?? all.find(({ lane }) => lane.id === model.lead) ?? all[0] ?? null;
}

/** The truth that all lanes share: whether the sensor of a node is attacked. */
export function sharedState(model: RunModel, detectors: readonly Detector[]): string | null {
  const nodes = new Set(detectors.map(({ node }) => node));
  return model.nodes.find(({ id, state }) => state !== null && nodes.has(id))?.state ?? detectors.find(({ state }) => state !== null)?.state ?? null;
}
