/// Sensors, the fusion centre and the one who listens: who sends what to whom at one tick.
import { colour } from '../../../chart/colours';
import { linkCell } from '../attack_cells';

export interface Channel {
  from: string;
  to: string;
  overheard: boolean;
  /** Attack on the link, 0: none. */
  state: number;
  /** Components that the sender contaminates. */
  contaminated: string[];
}

interface Place {
  x: number;
  y: number;
}

/** Senders below one another at the left, the centre at the right. */
export function placesOf(count: number, width: number, height: number): { senders: Place[]; centre: Place } {
  const reach = Math.max(0, height / 2 - 18);
  const senders = Array.from({ length: count }, (_, i) => ({ x: 16, y: height / 2 + (count > 1 ? (2 * (i / (count - 1)) - 1) * Math.min(reach, 26 * (count - 1)) : 0) }));
  return { senders, centre: { x: width - 20, y: height / 2 } };
}

const font = "600 11px 'IBM Plex Mono', monospace";

export function drawNetwork(context: CanvasRenderingContext2D, width: number, height: number, channels: readonly Channel[], token: string): void {
  const { senders, centre } = placesOf(channels.length, width, height);
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  channels.forEach((channel, i) => drawChannel(context, channel, senders[i]!, centre));
  channels.forEach(({ from, contaminated }, i) => {
    const { x, y } = senders[i]!;
    context.beginPath();
    context.arc(x, y, 11, 0, 2 * Math.PI);
    context.fillStyle = colour('surface');
    context.fill();
    context.lineWidth = contaminated.length ? 2.4 : 1.4;
    context.strokeStyle = colour(contaminated.length ? token : 'ink');
    context.stroke();
    context.fillStyle = colour('ink');
    context.font = font;
    context.fillText(from, x, y + 0.5, 20);
    if (contaminated.length) badge(context, x + 11, y - 10, 'C', token);
  });
  // The centre is a square: no sensor stands there.
  context.beginPath();
  context.rect(centre.x - 12, centre.y - 12, 24, 24);
  context.fillStyle = colour('surface');
  context.fill();
  context.lineWidth = 2;
  context.strokeStyle = colour('ink');
  context.stroke();
  context.fillStyle = colour('ink');
  context.font = '600 12px Inter, sans-serif';
  context.fillText('Σ', centre.x, centre.y + 0.5);
}

function drawChannel(context: CanvasRenderingContext2D, { overheard, state }: Channel, from: Place, to: Place): void {
  const cell = linkCell(state);
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = Math.hypot(dx, dy) || 1;
  const [ux, uy] = [dx / length, dy / length];
  const [ax, ay, bx, by] = [from.x + 12 * ux, from.y + 12 * uy, to.x - 17 * ux, to.y - 17 * uy];
  context.strokeStyle = context.fillStyle = colour(cell ? cell.token : 'control');
  context.lineWidth = cell ? 2.4 : 1.3;
  context.setLineDash(cell?.letter === 'D' ? [3, 4] : []);
  context.beginPath();
  context.moveTo(ax, ay);
  context.lineTo(bx, by);
  context.stroke();
  context.setLineDash([]);
  context.beginPath();
  context.moveTo(bx + 4 * ux, by + 4 * uy);
  context.lineTo(bx - 4 * ux - 4 * uy, by - 4 * uy + 4 * ux);
  context.lineTo(bx - 4 * ux + 4 * uy, by - 4 * uy - 4 * ux);
  context.fill();
  if (overheard) badge(context, ax + 0.42 * (bx - ax), ay + 0.42 * (by - ay), 'E', 'overheard');
  if (cell) badge(context, ax + 0.75 * (bx - ax), ay + 0.75 * (by - ay), cell.letter, cell.token);
}

function badge(context: CanvasRenderingContext2D, x: number, y: number, letter: string, token: string): void {
  context.beginPath();
  context.roundRect(x - 6.5, y - 6.5, 13, 13, 3);
  context.fillStyle = colour('surface');
  context.fill();
  context.lineWidth = 1.3;
  context.strokeStyle = colour(token);
  context.stroke();
  context.fillStyle = colour(token);
  context.font = "600 9.5px 'IBM Plex Mono', monospace";
  context.fillText(letter, x, y + 0.5);
}
