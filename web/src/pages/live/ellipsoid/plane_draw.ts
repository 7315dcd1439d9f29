/// The plane of the first two components at one tick: truth, estimate, and how far the filter says they may be apart.
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { tickLabel, ticks } from '../../../chart/scale';
import type { Series } from '../../../data/series';
import type { Axes } from './ellipse';

export interface Way {
  x: Series;
  y: Series;
}

export interface Scene {
  truth: Way;
  estimate: Way;
  /** Of the bounded part, and of two standard deviations of the random part, about the estimate. */
  bounded: Axes | null;
  random: Axes | null;
  token: string;
  names: readonly [string, string];
  at: number;
  tail: number;
}

export interface Box {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
}

/** The newest point of a way up to a tick, no older than one tick. */
export function pointAt(way: Way, at: number): [number, number] | null {
  let best: [number, number] | null = null;
  eachPoint(way, at - 1, at, (x, y) => (best = [x, y]));
  return best;
}

function eachPoint(way: Way, from: number, to: number, take: (x: number, y: number, joined: boolean) => void): void {
  let j = 0;
  let whole = false;
  for (let i = 0; i < way.x.k.length; i++) {
    const k = way.x.k[i]!;
    if (k < from || k > to) continue;
    while (j < way.y.k.length && way.y.k[j]! < k) j++;
    if (way.y.k[j] !== k) continue;
    const [x, y] = [way.x.hi[i]!, way.y.hi[j]!];
    const known = Number.isFinite(x) && Number.isFinite(y);
    if (known) take(x, y, whole && way.x.joined[i] === 1);
    whole = known;
  }
}

/** Holds both ways and the ellipses. It grows at once and shrinks only when far too large, so that nothing jitters. */
export function boxOf(scene: Scene, before: Box | null): Box | null {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  const take = (x: number, y: number): void => {
    [x0, x1, y0, y1] = [Math.min(x0, x), Math.max(x1, x), Math.min(y0, y), Math.max(y1, y)];
  };
  for (const way of [scene.truth, scene.estimate]) eachPoint(way, scene.at - scene.tail, scene.at, take);
  const centre = pointAt(scene.estimate, scene.at);
  const radius = Math.max(scene.bounded?.a ?? 0, scene.random?.a ?? 0);
  if (centre) for (const sign of [-1, 1]) take(centre[0] + sign * radius, centre[1] + sign * radius);
  if (!(x1 >= x0)) return before;
  const pad = Math.max(x1 - x0, y1 - y0, 1e-9) * 0.08;
  const box = { x0: x0 - pad, x1: x1 + pad, y0: y0 - pad, y1: y1 + pad };
  if (!before) return box;
  const inside = x0 >= before.x0 && x1 <= before.x1 && y0 >= before.y0 && y1 <= before.y1;
  const wasteful = (before.x1 - before.x0) * (before.y1 - before.y0) > 3 * (box.x1 - box.x0) * (box.y1 - box.y0);
  return inside && !wasteful ? before : box;
}

const frame = { left: 40, right: 4, top: 4, bottom: 20 };

export function drawScene(context: CanvasRenderingContext2D, width: number, height: number, scene: Scene, box: Box): void {
  const [w, h] = [width - frame.left - frame.right, height - frame.top - frame.bottom];
  const scale = Math.min(w / (box.x1 - box.x0), h / (box.y1 - box.y0));
  const [cx, cy] = [(box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2];
  const X = (x: number): number => frame.left + w / 2 + (x - cx) * scale;
  const Y = (y: number): number => frame.top + h / 2 - (y - cy) * scale;
  drawGrid(context, { width, height, w, h, scale, cx, cy, X, Y }, scene.names);
  context.save();
  context.beginPath();
  context.rect(frame.left, frame.top, w, h);
  context.clip();
  const centre = pointAt(scene.estimate, scene.at);
  if (centre) {
    if (scene.bounded) drawEllipse(context, X(centre[0]), Y(centre[1]), scene.bounded, scale, scene.token, []);
    if (scene.random) drawEllipse(context, X(centre[0]), Y(centre[1]), scene.random, scale, scene.token, [4, 3]);
  }
  drawWay(context, scene.estimate, scene, X, Y, { token: scene.token, width: 1.2, dash: [] });
  drawWay(context, scene.truth, scene, X, Y, { token: 'ink', width: 2, dash: [6, 4] });
  if (centre) dot(context, X(centre[0]), Y(centre[1]), 4, scene.token, true);
  const truth = pointAt(scene.truth, scene.at);
  if (truth) dot(context, X(truth[0]), Y(truth[1]), 5.5, 'ink', false);
  context.restore();
}

interface Frame {
  width: number;
  height: number;
  w: number;
  h: number;
  scale: number;
  cx: number;
  cy: number;
  X: (x: number) => number;
  Y: (y: number) => number;
}

function drawGrid(context: CanvasRenderingContext2D, f: Frame, names: readonly [string, string]): void {
  context.font = axisFont;
  context.lineWidth = 1;
  context.strokeStyle = colour('grid');
  context.fillStyle = colour('muted');
  const floor = f.height - frame.bottom;
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  for (const x of ticks(f.cx - f.w / 2 / f.scale, f.cx + f.w / 2 / f.scale, f.w / 70)) {
    const p = Math.round(f.X(x)) + 0.5;
    line(context, p, frame.top, p, floor);
    if (p < f.width - 34) context.fillText(tickLabel(x), p, f.height - 5);
  }
  context.textAlign = 'right';
  context.fillText(names[0], f.width - frame.right, f.height - 5);
  context.textBaseline = 'middle';
  for (const y of ticks(f.cy - f.h / 2 / f.scale, f.cy + f.h / 2 / f.scale, f.h / 45)) {
    const p = Math.round(f.Y(y)) + 0.5;
    line(context, frame.left, p, f.width - frame.right, p);
    if (p > frame.top + 16) context.fillText(tickLabel(y), frame.left - 6, p);
  }
  context.fillText(names[1], frame.left - 6, frame.top + 6);
}

function line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

/** Solid and filled: the truth must be inside. Dashed: two standard deviations. */
function drawEllipse(context: CanvasRenderingContext2D, x: number, y: number, axes: Axes, scale: number, token: string, dash: number[]): void {
  context.beginPath();
  // The second component points up, the canvas down.
  context.ellipse(x, y, axes.a * scale, axes.b * scale, -axes.angle, 0, 2 * Math.PI);
  context.fillStyle = context.strokeStyle = colour(token);
  context.globalAlpha = dash.length ? 0.08 : 0.16;
  context.fill();
  context.globalAlpha = 1;
  context.lineWidth = 1.4;
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

function drawWay(context: CanvasRenderingContext2D, way: Way, scene: Scene, X: (x: number) => number, Y: (y: number) => number, look: { token: string; width: number; dash: number[] }): void {
  context.strokeStyle = colour(look.token);
  context.lineWidth = look.width;
  context.lineJoin = 'round';
  context.setLineDash(look.dash);
  context.beginPath();
  eachPoint(way, scene.at - scene.tail, scene.at, (x, y, joined) => (joined ? context.lineTo(X(x), Y(y)) : context.moveTo(X(x), Y(y))));
  context.stroke();
  context.setLineDash([]);
}

function dot(context: CanvasRenderingContext2D, x: number, y: number, radius: number, token: string, filled: boolean): void {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fillStyle = context.strokeStyle = colour(token);
  context.lineWidth = 2.2;
  if (filled) context.fill();
  else context.stroke();
}
