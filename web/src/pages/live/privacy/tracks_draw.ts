/// Paths in the plane: the true one, the user's and those of all who listen (seed 004, figure 2-5).
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { tickLabel, ticks } from '../../../chart/scale';
import type { Series } from '../../../data/series';
import { lastPoint, type PlaneBox } from '../plane_draw';
import type { Look } from './curves';

export interface Path {
  x: Series;
  y: Series;
  look: Look;
  /** Whether the picture must hold all of it; others may leave it. */
  held: boolean;
  truth?: boolean;
}

const room = { left: 36, right: 6, top: 4, bottom: 18 };
/** By how many of its own sizes the box of the true path grows for one who listens, at most. */
const mostGrowth = 1;

type Range = [number, number];

function rangeOf(paths: readonly Path[], axis: 'x' | 'y', at: number): Range | null {
  let [lo, hi] = [Infinity, -Infinity];
  for (const path of paths) {
    const series = path[axis];
    for (let i = 0; i < series.k.length; i++) {
      if (series.k[i]! > at || Number.isNaN(series.lo[i]!)) continue;
      lo = Math.min(lo, series.lo[i]!);
      hi = Math.max(hi, series.hi[i]!);
    }
  }
  return lo <= hi ? [lo, hi] : null;
}

/** What the picture shows: all of the true and the user's path, and of the others what is not too far away. */
export function boxOf(paths: readonly Path[], at: number): PlaneBox | null {
  const held = paths.filter((path) => path.held);
  const [x, y] = [rangeOf(held, 'x', at), rangeOf(held, 'y', at)];
  if (!x || !y) return null;
  const size = Math.max(x[1] - x[0], y[1] - y[0], 1e-9);
  const grown = (own: Range, all: Range | null): Range => {
    const reach = mostGrowth * size;
    return [Math.max(own[0] - reach, Math.min(own[0], all?.[0] ?? own[0])) - 0.05 * size, Math.min(own[1] + reach, Math.max(own[1], all?.[1] ?? own[1])) + 0.05 * size];
  };
  const [x0, x1] = grown(x, rangeOf(paths, 'x', at));
  const [y0, y1] = grown(y, rangeOf(paths, 'y', at));
  return { x0, x1, y0, y1 };
}

export function drawPaths(context: CanvasRenderingContext2D, width: number, height: number, paths: readonly Path[], at: number): void {
  const box = boxOf(paths, at);
  if (!box) return;
  const [w, h] = [width - room.left - room.right, height - room.top - room.bottom];
  const scale = Math.min(w / (box.x1 - box.x0), h / (box.y1 - box.y0));
  const [cx, cy] = [(box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2];
  const X = (x: number): number => room.left + w / 2 + (x - cx) * scale;
  const Y = (y: number): number => room.top + h / 2 - (y - cy) * scale;
  drawGrid(context, width, height, { x: [cx - w / 2 / scale, cx + w / 2 / scale], y: [cy - h / 2 / scale, cy + h / 2 / scale] }, X, Y);
  context.save();
  context.beginPath();
  context.rect(room.left, room.top, w, h);
  context.clip();
  for (const path of paths) drawPath(context, path, at, X, Y);
  for (const path of paths) drawEnd(context, path, at, X, Y);
  context.restore();
}

function drawGrid(context: CanvasRenderingContext2D, width: number, height: number, range: { x: Range; y: Range }, X: (v: number) => number, Y: (v: number) => number): void {
  context.font = axisFont;
  context.lineWidth = 1;
  context.strokeStyle = colour('grid');
  context.fillStyle = colour('muted');
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  for (const x of ticks(...range.x, Math.max(2, width / 75))) {
    const p = Math.round(X(x)) + 0.5;
    rule(context, p, room.top, p, height - room.bottom);
    context.fillText(tickLabel(x), Math.min(p, width - 12), height - 4);
  }
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  for (const y of ticks(...range.y, Math.max(2, height / 50))) {
    const p = Math.round(Y(y)) + 0.5;
    rule(context, room.left, p, width - room.right, p);
    context.fillText(tickLabel(y), room.left - 5, p);
  }
}

function rule(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

function drawPath(context: CanvasRenderingContext2D, { x, y, look }: Path, at: number, X: (v: number) => number, Y: (v: number) => number): void {
  context.strokeStyle = colour(look.token);
  context.lineWidth = look.width;
  context.lineJoin = 'round';
  context.setLineDash(look.dash);
  context.beginPath();
  let pen = false;
  for (let i = 0; i < Math.min(x.k.length, y.k.length); i++) {
    if (x.k[i]! > at) break;
    const [px, py] = [x.hi[i]!, y.hi[i]!];
    if (!Number.isFinite(px + py)) {
      pen = false;
      continue;
    }
    if (pen && x.joined[i]) context.lineTo(X(px), Y(py));
    else context.moveTo(X(px), Y(py));
    pen = true;
  }
  context.stroke();
  context.setLineDash([]);
}

/** Where each is at the tick: the true place a ring, the user a disc, who listens a square. */
function drawEnd(context: CanvasRenderingContext2D, path: Path, at: number, X: (v: number) => number, Y: (v: number) => number): void {
  const point = lastPoint(path, at);
  if (!point) return;
  const [x, y] = [X(point[0]), Y(point[1])];
  context.strokeStyle = context.fillStyle = colour(path.look.token);
  context.lineWidth = 2;
  context.beginPath();
  if (path.truth) {
    context.arc(x, y, 6, 0, 2 * Math.PI);
    context.stroke();
  } else if (path.held) {
    context.arc(x, y, 4, 0, 2 * Math.PI);
    context.fill();
  } else context.fillRect(x - 3.5, y - 3.5, 7, 7);
}
