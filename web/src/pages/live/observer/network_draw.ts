/// The network of subsystems: a box each with its sizes, an arrow a coupling, signs for what happens at the cursor.
import { colour } from '../../../chart/colours';
import type { Arrow, SubsystemModel } from './subsystems';

export interface NodeState {
  attacked: boolean;
  faulty: boolean;
  /** Whether the matching condition holds; null: no lane asks for it. */
  matched: boolean | null;
  chosen: boolean;
}

export interface NodePicture {
  subsystem: SubsystemModel;
  state: NodeState;
}

interface Place {
  x: number;
  y: number;
}

const half = { width: 39, height: 17 };

/** px from a box's centre within which a hand takes it. */
export const boxRadius = 26;

/** px by which the inner boxes of a row stand out, so that arrows along the row pass them by. */
const bow = 21;

/** The centres of the boxes, in the order of a walk round: alone in the middle, two side by side, more in two rows. */
export function places(count: number, width: number, height: number): Place[] {
  const [cx, cy] = [width / 2, height / 2];
  if (count === 1) return [{ x: cx, y: cy }];
  const reach = Math.max(0, cx - half.width - 6);
  const rise = Math.max(0, cy - half.height - 9);
  const row = (boxes: number, side: -1 | 1): Place[] => {
    const apart = Math.min(170, (2 * reach) / Math.max(1, boxes - 1));
    const out = boxes > 2 ? Math.min(bow, rise / 2) : 0;
    return Array.from({ length: boxes }, (_, i) => {
      const inner = i > 0 && i < boxes - 1;
      return { x: cx + (i - (boxes - 1) / 2) * apart, y: cy + side * (rise - (inner ? 0 : out)) };
    });
  };
  if (count === 2) return row(2, -1).map(({ x }) => ({ x, y: cy }));
  const above = Math.ceil(count / 2);
  return [...row(above, -1), ...row(count - above, 1).reverse()];
}

/** Where a ray from a box's centre leaves it. */
export function leaving(from: Place, to: Place, room = 4): Place {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const share = Math.min((half.width + room) / Math.abs(dx || 1e-9), (half.height + room) / Math.abs(dy || 1e-9), 0.49);
  return { x: from.x + share * dx, y: from.y + share * dy };
}

export function drawNetwork(context: CanvasRenderingContext2D, width: number, height: number, nodes: readonly NodePicture[], arrows: readonly Arrow[]): void {
  const at = places(nodes.length, width, height);
  const index = new Map(nodes.map(({ subsystem }, i) => [subsystem.id, i]));
  for (const { from, to } of arrows) {
    const [a, b] = [index.get(from), index.get(to)];
    if (a !== undefined && b !== undefined) drawArrow(context, leaving(at[a]!, at[b]!), leaving(at[b]!, at[a]!));
  }
  nodes.forEach((node, i) => drawNode(context, at[i]!, node));
}

function drawArrow(context: CanvasRenderingContext2D, from: Place, to: Place): void {
  const angle = Math.atan2(to.y - from.y, to.x - from.x);
  context.strokeStyle = colour('muted');
  context.fillStyle = colour('muted');
  context.lineWidth = 1.2;
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  context.stroke();
  context.beginPath();
  context.moveTo(to.x, to.y);
  for (const side of [0.42, -0.42]) context.lineTo(to.x - 8 * Math.cos(angle + side), to.y - 8 * Math.sin(angle + side));
  context.fill();
}

function drawNode(context: CanvasRenderingContext2D, { x, y }: Place, { subsystem, state }: NodePicture): void {
  const [left, top] = [x - half.width, y - half.height];
  context.fillStyle = colour('raised');
  context.strokeStyle = colour(state.attacked ? 'fdi' : state.chosen ? 'ink' : 'control');
  context.lineWidth = state.attacked || state.chosen ? 2 : 1;
  context.beginPath();
  context.roundRect(left, top, 2 * half.width, 2 * half.height, 5);
  context.fill();
  context.stroke();
  context.textBaseline = 'middle';
  context.textAlign = 'center';
  context.fillStyle = colour('ink');
  context.font = "600 12px Inter, sans-serif";
  context.fillText(subsystem.id, x, y - 7, 2 * half.width - 36);
  context.font = "10px 'IBM Plex Mono', monospace";
  const { n, p, q, g } = subsystem.sizes;
  context.fillText(`${n}·${p}·${q}·${g}`, x, y + 8);
  if (state.matched !== null) drawFlag(context, left + 10, y - 7, state.matched);
  const badges = [...(state.attacked ? [['w', 'fdi'] as const] : []), ...(state.faulty ? [['f', 'dos'] as const] : [])];
  badges.forEach(([letter, token], i) => drawBadge(context, x + half.width - 5 - 15 * i, top, letter, token));
}

/** A tick or a cross: the shape says it, the colour says it again. */
function drawFlag(context: CanvasRenderingContext2D, x: number, y: number, holds: boolean): void {
  context.strokeStyle = colour(holds ? 'good' : 'bad');
  context.lineWidth = 2;
  context.beginPath();
  if (holds) {
    context.moveTo(x - 4, y);
    context.lineTo(x - 1, y + 3.5);
    context.lineTo(x + 4, y - 4);
  } else {
    context.moveTo(x - 3.5, y - 3.5);
    context.lineTo(x + 3.5, y + 3.5);
    context.moveTo(x + 3.5, y - 3.5);
    context.lineTo(x - 3.5, y + 3.5);
  }
  context.stroke();
}

function drawBadge(context: CanvasRenderingContext2D, x: number, y: number, letter: string, token: string): void {
  context.fillStyle = colour(token);
  context.beginPath();
  context.roundRect(x - 7, y - 7, 14, 14, 3);
  context.fill();
  context.fillStyle = colour('surface');
  context.font = "600 10px 'IBM Plex Mono', monospace";
  context.fillText(letter, x, y + 0.5);
}
