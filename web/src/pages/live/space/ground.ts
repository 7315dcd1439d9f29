/// What stands behind the ways: the ground with its grid and axes, or the grid of a plane.
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { tickLabel, ticks } from '../../../chart/scale';
import { dot, type Box, type Margins, type Point, type Projection, type Sight } from './projection';

export interface AxisWords {
  names: readonly [string, string, string];
  unit: string;
}

/** Pixels between two lines of the grid, about. */
const apart = 46;

function segment(context: CanvasRenderingContext2D, p: Projection, a: Point, b: Point): void {
  context.moveTo(p.x(...a), p.y(...a));
  context.lineTo(p.x(...b), p.y(...b));
}

function label(context: CanvasRenderingContext2D, p: Projection, at: Point, out: readonly [number, number], text: string): void {
  context.fillText(text, p.x(...at) + out[0], p.y(...at) + out[1]);
}

/** A direction in space as one on the screen, of a given length, never upwards where `down` asks so. */
function outward(p: Projection, x: number, y: number, length: number): [number, number] {
  const [sx, sy] = [dot(p.basis.right, x, y, 0), -dot(p.basis.up, x, y, 0)];
  const [dx, dy] = [sx, Math.max(sy, 0.35)];
  const size = Math.hypot(dx, dy) || 1;
  return [(dx / size) * length, (dy / size) * length];
}

/** The ground's grid, its two axes at the edges nearest to the eye, and the height at the corner farthest to the left. */
export function drawGround(context: CanvasRenderingContext2D, p: Projection, box: Box, ground: number, words: AxisWords): void {
  const { min, max } = box;
  const count = (axis: 0 | 1): number => Math.max(2, ((max[axis] - min[axis]) * p.scale) / apart);
  const [xs, ys] = [ticks(min[0], max[0], count(0)), ticks(min[1], max[1], count(1))];
  context.lineWidth = 1;
  context.strokeStyle = colour('grid');
  context.beginPath();
  for (const x of xs) segment(context, p, [x, min[1], ground], [x, max[1], ground]);
  for (const y of ys) segment(context, p, [min[0], y, ground], [max[0], y, ground]);
  context.stroke();
  context.strokeStyle = colour('line');
  context.beginPath();
  outline(context, p, box, ground);
  context.stroke();

  context.font = axisFont;
  context.fillStyle = colour('muted');
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  const side = { x: p.basis.eye[0] >= 0 ? 1 : -1, y: p.basis.eye[1] >= 0 ? 1 : -1 };
  const near = { x: side.x > 0 ? max[0] : min[0], y: side.y > 0 ? max[1] : min[1] };
  const [outX, outY] = [outward(p, 0, side.y, 14), outward(p, side.x, 0, 14)];
  for (const x of xs.slice(1, -1)) label(context, p, [x, near.y, ground], outX, tickLabel(x));
  for (const y of ys.slice(1, -1)) label(context, p, [near.x, y, ground], outY, tickLabel(y));
  drawHeight(context, p, box, ground, words);
  context.fillStyle = colour('ink');
  context.textAlign = 'center';
  label(context, p, [(min[0] + max[0]) / 2, near.y, ground], scaled(outX, 2.1), `${words.names[0]}, ${words.unit}`);
  label(context, p, [near.x, (min[1] + max[1]) / 2, ground], scaled(outY, 2.1), `${words.names[1]}, ${words.unit}`);
}

function scaled([x, y]: readonly [number, number], by: number): [number, number] {
  return [x * by, y * by];
}

function outline(context: CanvasRenderingContext2D, p: Projection, { min, max }: Box, ground: number): void {
  context.moveTo(p.x(min[0], min[1], ground), p.y(min[0], min[1], ground));
  context.lineTo(p.x(max[0], min[1], ground), p.y(max[0], min[1], ground));
  context.lineTo(p.x(max[0], max[1], ground), p.y(max[0], max[1], ground));
  context.lineTo(p.x(min[0], max[1], ground), p.y(min[0], max[1], ground));
  context.closePath();
}

function drawHeight(context: CanvasRenderingContext2D, p: Projection, { min, max }: Box, ground: number, words: AxisWords): void {
  let corner: [number, number] = [min[0], min[1]];
  for (const x of [min[0], max[0]]) for (const y of [min[1], max[1]]) if (p.x(x, y, ground) < p.x(corner[0], corner[1], ground)) corner = [x, y];
  const tall = (max[2] - min[2]) * p.scale * p.basis.up[2];
  if (tall < 12) return;
  context.strokeStyle = colour('control');
  context.beginPath();
  segment(context, p, [...corner, min[2]], [...corner, max[2]]);
  context.stroke();
  context.textAlign = 'right';
  const levels = ticks(min[2], max[2], Math.max(1, tall / 34));
  for (const z of levels) {
    const at: Point = [...corner, z];
    context.beginPath();
    context.moveTo(p.x(...at) - 3, p.y(...at));
    context.lineTo(p.x(...at) + 3, p.y(...at));
    context.stroke();
    if (z !== ground) label(context, p, at, [-6, 0], tickLabel(z));
  }
  context.fillStyle = colour('ink');
  context.textAlign = 'left';
  label(context, p, [...corner, max[2]], [-8, -10], `${words.names[2]}, ${words.unit}`);
}

const drawn: Record<Exclude<Sight, 'space'>, readonly [0 | 1 | 2, 0 | 1 | 2]> = { xy: [0, 1], xz: [0, 2], yz: [1, 2] };

/** A plane's grid over the whole canvas, numbers at the left and below. */
export function drawPlaneGrid(context: CanvasRenderingContext2D, p: Projection, frame: Margins, sight: Exclude<Sight, 'space'>, words: AxisWords): void {
  const { width, height } = p;
  const [right, below] = [width - frame.right, height - frame.bottom];
  context.font = axisFont;
  context.lineWidth = 1;
  context.fillStyle = colour('muted');
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  for (const value of ticks(p.right(frame.left), p.right(right), width / 75)) {
    const x = Math.round(p.atRight(value)) + 0.5;
    rule(context, value, x, frame.top, x, below);
    context.fillText(tickLabel(value), x, height - 5);
  }
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  for (const value of ticks(p.up(below), p.up(frame.top), height / 60)) {
    const y = Math.round(p.atUp(value)) + 0.5;
    rule(context, value, frame.left, y, right, y);
    context.fillText(tickLabel(value), frame.left - 6, y);
  }
  context.fillStyle = colour('ink');
  const [across, up] = drawn[sight];
  context.fillText(`${words.names[across]}, ${words.unit}`, right - 2, below - 8);
  context.textAlign = 'left';
  context.fillText(`${words.names[up]}, ${words.unit}`, frame.left + 5, frame.top + 8);
}

function rule(context: CanvasRenderingContext2D, value: number, x0: number, y0: number, x1: number, y1: number): void {
  context.strokeStyle = colour(value === 0 ? 'line' : 'grid');
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}
