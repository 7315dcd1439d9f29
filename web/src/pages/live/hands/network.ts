/// The network as one picture for every family: nodes, directed links, and what acts on each at a tick.
import { linkCell, sensorCell } from '../attack_cells';
import type { RunModel } from '../model';
import { between, nodePlaces, receiverHalf, type Point, type Segment, type Target } from './layout';

/** px of a node's circle. */
export const nodeRadius = 12;

export interface DrawnNode {
  id: string;
  at: Point;
  /** No sensor stands there: the fusion centre. */
  centre: boolean;
  state: string | null;
  actuator: boolean;
}

export interface DrawnLink {
  id: string;
  line: Segment;
  /** Of one direction only: an arrow says which. */
  alone: boolean;
  state: string | null;
}

export interface Picture {
  nodes: DrawnNode[];
  links: DrawnLink[];
}

export function pictureOf(model: Pick<RunModel, 'nodes' | 'links' | 'centre'>, width: number, height: number): Picture {
  const centre = model.centre;
  const all = [...model.nodes.map(({ id, position, state, actuator }) => ({ id, position, state, actuator: actuator === true, centre: false })), ...(centre === null ? [] : [{ id: centre, position: null, state: null, actuator: false, centre: true }])];
  // A fusion centre stands in the middle of those that send to it.
  const ring = nodePlaces(
    all.filter((node) => !node.centre).map(({ position }) => ({ position: centre === null ? position : null })),
    width,
    height,
  );
  const nodes = all.map((node, i): DrawnNode => ({ ...node, at: node.centre ? { x: width / 2, y: height / 2 } : ring[i]! }));
  if (centre !== null && ring.length === 1) nodes[0]!.at = { x: width / 4, y: height / 2 };
  const place = new Map(nodes.map((node) => [node.id, node.at]));
  const known = new Set(model.links.map(({ from, to }) => `${from} ${to}`));
  const links = model.links.flatMap(({ id, from, to, state }): DrawnLink[] => {
    const [a, b] = [place.get(from), place.get(to)];
    if (!a || !b) return [];
    const alone = !known.has(`${to} ${from}`);
    return [{ id, alone, state, line: alone ? between(a, b, nodeRadius + 3) : receiverHalf(a, b, nodeRadius + 3) }];
  });
  return { nodes, links };
}

/** Links and those nodes that attacks can act on. */
export function pictureTargets(picture: Picture, taken: ReadonlySet<string>): Target[] {
  const links = picture.links.map(({ id, line }): Target => ({ id: `link:${id}`, shape: line }));
  const nodes = picture.nodes.map(({ id, at }): Target => ({ id: `node:${id}`, shape: { at, radius: nodeRadius } }));
  return [...links, ...nodes].filter(({ id }) => taken.has(id));
}

/** The cell of a link's or a sensor's state, with its letter; null: clean, or not told. */
export function cellOf(target: string, value: number): { token: string; letter: string } | null {
  return target.startsWith('link:') ? linkCell(value) : sensorCell(value);
}
