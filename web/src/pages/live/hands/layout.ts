/// Where nodes and links of a network are drawn, and where a hand can take them. CSS pixels.
export interface Point {
  x: number;
  y: number;
}

export interface Segment {
  a: Point;
  b: Point;
}

/** Nodes at their places, if all have one and not all the same; else round a circle, the first at the top. */
export function nodePlaces(nodes: readonly { position: readonly [number, number] | null }[], width: number, height: number, margin = 22): Point[] {
  const centre = { x: width / 2, y: height / 2 };
  const [rx, ry] = [Math.max(0, width / 2 - margin), Math.max(0, height / 2 - margin)];
  if (nodes.length === 1) return [centre];
  const placed = nodes.flatMap(({ position }) => (position ? [position] : []));
  const xs = placed.map(([x]) => x);
  const ys = placed.map(([, y]) => y);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  if (placed.length === nodes.length && Math.max(x1 - x0, y1 - y0) > 0) {
    const scale = Math.min((2 * rx) / (x1 - x0 || 1e-9), (2 * ry) / (y1 - y0 || 1e-9));
    return placed.map(([x, y]) => ({ x: centre.x + (x - (x0 + x1) / 2) * scale, y: centre.y - (y - (y0 + y1) / 2) * scale }));
  }
  return nodes.map((_, i) => {
    const angle = (2 * Math.PI * i) / nodes.length - Math.PI / 2;
    return { x: centre.x + rx * Math.cos(angle), y: centre.y + ry * Math.sin(angle) };
  });
}

/** The receiver's half of the line between two nodes: the part that belongs to this direction. `room`: px kept free about the receiver. */
export function receiverHalf(from: Point, to: Point, room: number): Segment {
  const middle = { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 };
  const length = Math.hypot(to.x - middle.x, to.y - middle.y);
  const share = length > 0 ? Math.max(0, 1 - room / length) : 0;
  return { a: middle, b: { x: middle.x + (to.x - middle.x) * share, y: middle.y + (to.y - middle.y) * share } };
}

/** The whole of it, with room about both ends: where only one direction exists. */
export function between(from: Point, to: Point, room: number): Segment {
  const back = receiverHalf(to, from, room);
  return { a: back.b, b: receiverHalf(from, to, room).b };
}

export function distance(point: Point, { a, b }: Segment): number {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const square = dx * dx + dy * dy;
  const share = square > 0 ? Math.max(0, Math.min(1, ((point.x - a.x) * dx + (point.y - a.y) * dy) / square)) : 0;
  return Math.hypot(point.x - a.x - share * dx, point.y - a.y - share * dy);
}

export interface Target {
  /** "link:1-2" or "node:3". */
  id: string;
  shape: { at: Point; radius: number } | Segment;
}

/** The target under a point: a node before a link, of several links the nearest within `reach`. */
export function hit(targets: readonly Target[], point: Point, reach = 8): Target | null {
  let best: { target: Target; far: number } | null = null;
  for (const target of targets) {
    const node = 'at' in target.shape;
    const far = 'at' in target.shape ? Math.hypot(point.x - target.shape.at.x, point.y - target.shape.at.y) - target.shape.radius : distance(point, target.shape);
    if (far > (node ? 2 : reach)) continue;
    // A node lies above the links.
    const rank = node ? far - 1000 : far;
    if (!best || rank < best.far) best = { target, far: rank };
  }
  return best?.target ?? null;
}
