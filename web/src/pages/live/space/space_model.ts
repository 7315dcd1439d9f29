/// What a run offers to the picture of its space: components, stations, and the signals of every way.
import type { RunDetail } from '../../../api/types';
import { nodeLook, type NodeLook } from '../../../chart/marks';
import type { LaneModel, RunModel } from '../model';
import type { Point } from './projection';

export type Names = readonly [x: string, y: string, z: string];

export interface Station {
  id: string;
  place: Point | null;
  /** Signal that tells which attack acts on it. */
  state: string | null;
}

export interface SpaceModel {
  components: Names;
  unit: string;
  truth: Names;
  stations: Station[];
  links: { from: string; to: string }[];
}

export interface NodeWay {
  id: string;
  look: NodeLook;
  names: Names;
}

export function spaceModel(run: RunDetail, model: RunModel): SpaceModel | null {
  const components = run.view?.space?.components;
  if (!components || components.length !== 3) return null;
  const truth: Names = [`truth.${components[0]}`, `truth.${components[1]}`, `truth.${components[2]}`];
  const known = new Map(model.signals.map((signal) => [signal.name, signal]));
  if (!truth.every((name) => known.has(name))) return null;
  return {
    components,
    unit: run.view.space!.unit ?? known.get(truth[0])!.unit,
    truth,
    stations: model.nodes.map(({ id, state }) => ({ id, state, place: placeOf(run, id) })),
    links: pairs(run),
  };
}

/** A station's place: of the world, or as its sensor was given it. */
function placeOf(run: RunDetail, id: string): Point | null {
  const told = run.world?.nodes.find((node) => node.id === id)?.position;
  if (told && told.length === 3) return point(told);
  const nodes = run.document?.nodes as Record<string, { sensor?: { params?: { position?: unknown } } } | null> | undefined;
  const given = nodes?.[id]?.sensor?.params?.position;
  return Array.isArray(given) && given.length === 3 ? point(given) : null;
}

function point(values: readonly unknown[]): Point | null {
  const [x, y, z] = values.map(Number);
  return Number.isFinite(x! + y! + z!) ? [x!, y!, z!] : null;
}

/** Each pair of linked nodes once. */
function pairs(run: RunDetail): { from: string; to: string }[] {
  const seen = new Set<string>();
  return (run.world?.links ?? []).filter(({ from, to }) => {
    const key = from < to ? `${from} ${to}` : `${to} ${from}`;
    if (seen.has(key)) return false;
    seen.add(key);
    return true;
  });
}

/** The ways of a lane's nodes. A node keeps its look whatever the lane. */
export function waysOf(lane: LaneModel | null, model: RunModel, components: Names): NodeWay[] {
  if (!lane) return [];
  const known = new Set(model.signals.map((signal) => signal.name));
  const ways: NodeWay[] = [];
  for (const id of lane.outputs) {
    const [x, y, z] = components.map((component) => `lane.${lane.id}.${id}.estimate.${component}`);
    if (known.has(x!) && known.has(y!) && known.has(z!)) ways.push({ id, look: lookOf(model, id), names: [x!, y!, z!] });
  }
  return ways;
}

/** How a node looks on every panel: by its place in the world, after them what is no node. */
export function lookOf(model: RunModel, id: string): NodeLook {
  const index = model.nodes.findIndex((node) => node.id === id);
  return nodeLook(index < 0 ? model.nodes.length : index);
}
