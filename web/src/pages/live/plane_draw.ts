/// The plane as a picture: nodes and links, the true way, the estimates' ways.
import { axisFont } from '../../chart/axes';
import { colour } from '../../chart/colours';
import { tickLabel, ticks } from '../../chart/scale';
import type { Series } from '../../data/series';
import { linkCell } from './attack_cells';

export interface Track {
  x: Series;
  y: Series;
}

export interface PlaneScene {
  /** `centre`: no sensor stands there; drawn as a square. */
  /** `attack`: how its sensor is attacked. */
  nodes: { id: string; position: [number, number] | null; centre?: boolean; attack?: { token: string; letter: string } | null }[];
  links: { from: string; to: string; value: number }[];
  truth: Track;
  estimates: { id: string; track: Track; chosen: boolean }[];
  token: string;
  /** Tick up to which the ways are drawn. */
  at: number;
  trail: number;
}

/** The nodes and, among them in the middle of those whose place is known, the fusion centre. */
export function withCentre(nodes: PlaneScene['nodes'], centre: string | null): PlaneScene['nodes'] {
  const placed = nodes.flatMap(({ position }) => (position ? [position] : []));
  if (centre === null || !placed.length) return nodes;
  const mean = (axis: 0 | 1): number => placed.reduce((sum, position) => sum + position[axis], 0) / placed.length;
  return [...nodes, { id: centre, position: [mean(0), mean(1)], centre: true }];
}

export interface PlaneBox {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
}

export function lastPoint(track: Track, at: number): [number, number] | null {
  for (let i = Math.min(track.x.k.length, track.y.k.length) - 1; i >= 0; i--) {
    if (track.x.k[i]! > at) continue;
    const [x, y] = [track.x.hi[i]!, track.y.hi[i]!];
    return Number.isFinite(x) && Number.isFinite(y) ? [x, y] : null;
  }
  return null;
}

/** A box about the nodes and the true way. It grows at once and shrinks only when far too large, so that nothing jitters. */
export function planeBox(scene: PlaneScene, before: PlaneBox | null): PlaneBox | null {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  const take = (x: number, y: number): void => {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return;
    x0 = Math.min(x0, x);
    x1 = Math.max(x1, x);
    y0 = Math.min(y0, y);
    y1 = Math.max(y1, y);
  };
  for (const { position } of scene.nodes) if (position) take(position[0], position[1]);
  const { x, y } = scene.truth;
  for (let i = 0; i < Math.min(x.k.length, y.k.length); i++) if (x.k[i]! <= scene.at && x.k[i]! >= scene.at - scene.trail) take(x.hi[i]!, y.hi[i]!);
  if (!(x1 >= x0)) return before;
  const pad = Math.max(x1 - x0, y1 - y0, 1e-9) * 0.08;
  const box = { x0: x0 - pad, x1: x1 + pad, y0: y0 - pad, y1: y1 + pad };
  if (!before) return box;
  const inside = x0 >= before.x0 && x1 <= before.x1 && y0 >= before.y0 && y1 <= before.y1;
  const wasteful = (before.x1 - before.x0) * (before.y1 - before.y0) > 3 * (box.x1 - box.x0) * (box.y1 - box.y0);
  return inside && !wasteful ? before : box;
}

/** From the plane's unit to px. */
export function planeMap(box: PlaneBox, width: number, height: number): { X: Map1; Y: Map1; scale: number; cx: number; cy: number } {
  const scale = Math.min((width - 44) / (box.x1 - box.x0), (height - 24) / (box.y1 - box.y0));
  const cx = (box.x0 + box.x1) / 2;
  const cy = (box.y0 + box.y1) / 2;
  return { X: (x) => 36 + (width - 44) / 2 + (x - cx) * scale, Y: (y) => 4 + (height - 24) / 2 - (y - cy) * scale, scale, cx, cy };
}

export function drawPlane(context: CanvasRenderingContext2D, width: number, height: number, scene: PlaneScene, box: PlaneBox): void {
  const { X, Y, scale, cx, cy } = planeMap(box, width, height);
  grid(context, width, height, X, Y, scale, cx, cy);
  context.save();
  context.beginPath();
  context.rect(36, 2, width - 38, height - 20);
  context.clip();
  const badges = links(context, scene, X, Y);
  for (const estimate of scene.estimates) way(context, estimate.track, scene, X, Y, { token: scene.token, width: estimate.chosen ? 1.8 : 0.9, alpha: estimate.chosen ? 1 : 0.6, dash: [] });
  way(context, scene.truth, scene, X, Y, { token: 'ink', width: 2.2, alpha: 1, dash: [6, 4] });
  for (const estimate of scene.estimates) dot(context, lastPoint(estimate.track, scene.at), X, Y, scene.token, estimate.chosen ? 4.5 : 3, true);
  dot(context, lastPoint(scene.truth, scene.at), X, Y, 'ink', 6, false);
  for (const badge of badges) drawBadge(context, badge);
  nodes(context, scene, X, Y);
  context.restore();
}

interface Badge {
  x: number;
  y: number;
  letter: string;
  token: string;
}

type Map1 = (v: number) => number;

function grid(context: CanvasRenderingContext2D, width: number, height: number, X: Map1, Y: Map1, scale: number, cx: number, cy: number): void {
  const half = { x: (width - 44) / 2 / scale, y: (height - 24) / 2 / scale };
  context.font = axisFont;
  context.lineWidth = 1;
  context.strokeStyle = colour('grid');
  context.fillStyle = colour('muted');
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  const step = Math.max(2, Math.min(width, height) / 75);
  for (const x of ticks(cx - half.x, cx + half.x, (step * width) / height)) {
    const p = Math.round(X(x)) + 0.5;
    line(context, p, 2, p, height - 18);
    context.fillText(tickLabel(x), p, height - 4);
  }
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  for (const y of ticks(cy - half.y, cy + half.y, step)) {
    const p = Math.round(Y(y)) + 0.5;
    line(context, 36, p, width - 2, p);
    context.fillText(tickLabel(y), 30, p);
  }
}

function line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

function way(context: CanvasRenderingContext2D, track: Track, scene: PlaneScene, X: Map1, Y: Map1, look: { token: string; width: number; alpha: number; dash: number[] }): void {
  context.strokeStyle = colour(look.token);
  context.globalAlpha = look.alpha;
  context.lineWidth = look.width;
  context.lineJoin = 'round';
  context.setLineDash(look.dash);
  context.beginPath();
  let pen = false;
  const length = Math.min(track.x.k.length, track.y.k.length);
  for (let i = 0; i < length; i++) {
    const k = track.x.k[i]!;
    if (k > scene.at || k < scene.at - scene.trail) continue;
    const [x, y] = [track.x.hi[i]!, track.y.hi[i]!];
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      pen = false;
      continue;
    }
    if (pen && track.x.joined[i]) context.lineTo(X(x), Y(y));
    else context.moveTo(X(x), Y(y));
    pen = true;
  }
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function dot(context: CanvasRenderingContext2D, at: [number, number] | null, X: Map1, Y: Map1, token: string, radius: number, filled: boolean): void {
  if (!at) return;
  context.beginPath();
  context.arc(X(at[0]), Y(at[1]), radius, 0, 2 * Math.PI);
  if (filled) {
    context.fillStyle = colour(token);
    context.fill();
    return;
  }
  context.lineWidth = 2.2;
  context.strokeStyle = colour(token);
  context.stroke();
}

function nodes(context: CanvasRenderingContext2D, scene: PlaneScene, X: Map1, Y: Map1): void {
  const many = scene.nodes.length > 10;
  context.font = `600 ${many ? 9 : 11}px 'IBM Plex Mono', monospace`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const { id, position, centre, attack } of scene.nodes) {
    if (!position) continue;
    const [x, y] = [X(position[0]), Y(position[1])];
    context.beginPath();
    if (centre) context.rect(x - 21, y - 9, 42, 18);
    else context.arc(x, y, many ? 7.5 : id.length > 1 ? 10.5 : 9, 0, 2 * Math.PI);
    context.fillStyle = colour('surface');
    context.fill();
    context.lineWidth = attack ? 2.4 : 1.4;
    context.strokeStyle = colour(attack ? attack.token : 'ink');
    context.stroke();
    context.fillStyle = colour('ink');
    context.fillText(id, x, y + 0.5);
    if (!attack) continue;
    context.save();
    drawBadge(context, { x: x + 12, y: y - 10, ...attack });
    context.restore();
  }
}

/** Each undirected pair once as a thin line; each attacked direction with its letter, nearer to the receiver. */
function links(context: CanvasRenderingContext2D, scene: PlaneScene, X: Map1, Y: Map1): Badge[] {
  const place = new Map(scene.nodes.filter((node) => node.position).map((node) => [node.id, node.position!]));
  const badges: Badge[] = [];
  for (const pass of [false, true]) {
    for (const { from, to, value } of scene.links) {
      const [a, b] = [place.get(from), place.get(to)];
      const cell = linkCell(value);
      if (!a || !b || (cell !== null) !== pass) continue;
      const [ax, ay, bx, by] = [X(a[0]), Y(a[1]), X(b[0]), Y(b[1])];
      if (!cell) {
        context.strokeStyle = colour('control');
        context.lineWidth = 1;
        line(context, ax, ay, bx, by);
        continue;
      }
      const [mx, my] = [(ax + bx) / 2, (ay + by) / 2];
      context.strokeStyle = colour(cell.token);
      context.lineWidth = 2.4;
      context.setLineDash(cell.letter === 'D' ? [3, 4] : cell.letter === 'R' ? [8, 4] : []);
      line(context, mx, my, bx, by);
      context.setLineDash([]);
      const length = Math.hypot(bx - mx, by - my) || 1;
      const share = Math.max(0.2, Math.min(0.45, 1 - 20 / length));
      badges.push({ x: mx + (bx - mx) * share, y: my + (by - my) * share, letter: cell.letter, token: cell.token });
    }
  }
  return badges;
}

function drawBadge(context: CanvasRenderingContext2D, badge: Badge): void {
  context.beginPath();
  context.roundRect(badge.x - 6.5, badge.y - 6.5, 13, 13, 2.5);
  context.fillStyle = colour('surface');
  context.fill();
  context.lineWidth = 1.2;
  context.strokeStyle = colour(badge.token);
  context.stroke();
  context.fillStyle = colour(badge.token);
  context.font = "600 9.5px 'IBM Plex Mono', monospace";
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(badge.letter, badge.x, badge.y + 0.5);
}
