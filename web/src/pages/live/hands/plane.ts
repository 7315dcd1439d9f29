/// Where the plane's drawing has its links and nodes.
import { planeMap, type PlaneBox, type PlaneScene } from '../plane_draw';
import { between, receiverHalf, type Point, type Target } from './layout';

const nodeRadius = 10;

export function planeTargets(scene: Pick<PlaneScene, 'nodes'> & { links: readonly { from: string; to: string }[] }, box: PlaneBox, width: number, height: number, taken: ReadonlySet<string>): Target[] {
  const { X, Y } = planeMap(box, width, height);
  const at = new Map(scene.nodes.flatMap(({ id, position }): [string, Point][] => (position ? [[id, { x: X(position[0]), y: Y(position[1]) }]] : [])));
  const known = new Set(scene.links.map(({ from, to }) => `${from} ${to}`));
  const links = scene.links.flatMap(({ from, to }): Target[] => {
    const [a, b] = [at.get(from), at.get(to)];
    if (!a || !b) return [];
    return [{ id: `link:${from}-${to}`, shape: known.has(`${to} ${from}`) ? receiverHalf(a, b, nodeRadius + 2) : between(a, b, nodeRadius + 2) }];
  });
  const nodes = [...at].map(([id, place]): Target => ({ id: `node:${id}`, shape: { at: place, radius: nodeRadius } }));
  return [...links, ...nodes].filter(({ id }) => taken.has(id));
}
