/// Marks of the nodes: a shape, a colour and a dash each, the same on every panel that draws one line or point a node.
import { laneDash, laneToken } from './colours';

/** Outlines in a box from -1 to 1, as SVG writes them: the same text serves canvases and legends. */
const shapes = [
  'M-.9 0A.9.9 0 1 0 .9 0A.9.9 0 1 0-.9 0Z',
  'M-.8-.8H.8V.8H-.8Z',
  'M0-1L1 .8H-1Z',
  'M0-1.1L1.1 0L0 1.1L-1.1 0Z',
  'M-.35-1H.35V-.35H1V.35H.35V1H-.35V.35H-1V-.35H-.35Z',
  'M0 1L1-.8H-1Z',
  'M-1-.55L-.55-1L0-.45L.55-1L1-.55L.45 0L1 .55L.55 1L0 .45L-.55 1L-1 .55L-.45 0Z',
  'M0-1.1L.3-.35H1.05L.45.12L.68.9L0 .45L-.68.9L-.45.12L-1.05-.35H-.3Z',
] as const;

export interface NodeLook {
  shape: string;
  token: string;
  dash: number[];
}

export function nodeLook(index: number): NodeLook {
  // The shape moves on where the colours begin anew: no two of many nodes are alike.
  const moved = index + Math.floor(index / shapes.length);
  return { shape: shapes[moved % shapes.length]!, token: laneToken(index), dash: laneDash(index) };
}

const paths = new Map<string, Path2D>();

/** Draws a shape of `radius` CSS pixels about a point in the context's fill colour, with an edge in its stroke colour. */
export function drawMark(context: CanvasRenderingContext2D, shape: string, x: number, y: number, radius: number): void {
  let path = paths.get(shape);
  if (!path) paths.set(shape, (path = new Path2D(shape)));
  context.save();
  context.translate(x, y);
  context.scale(radius, radius);
  context.lineWidth = 2.4 / radius;
  context.lineJoin = 'round';
  context.stroke(path);
  context.fill(path);
  context.restore();
}
