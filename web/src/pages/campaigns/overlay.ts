/// What lies above a drawing while somebody points at it.
import { prepare } from '../../chart/axes';
import { colour } from '../../chart/colours';
import type { Hit } from './scene';

export interface Rubber {
  ax: number;
  ay: number;
  bx: number;
  by: number;
}

export function paintOverlay(canvas: HTMLCanvasElement, width: number, height: number, hit: Hit | null, rubber: Rubber | null): void {
  const context = prepare(canvas, width, height);
  if (!context) return;
  if (hit?.path) {
    context.strokeStyle = colour('ink');
    context.lineWidth = 2;
    context.beginPath();
    for (let i = 0; i < hit.path.length; i += 2) context.lineTo(hit.path[i]!, hit.path[i + 1]!);
    context.stroke();
  }
  if (hit) {
    context.strokeStyle = colour('accent');
    context.lineWidth = 2;
    context.beginPath();
    context.arc(hit.x, hit.y, 5.5, 0, 2 * Math.PI);
    context.stroke();
  }
  if (rubber) {
    context.fillStyle = colour('accent');
    context.globalAlpha = 0.12;
    context.fillRect(rubber.ax, rubber.ay, rubber.bx - rubber.ax, rubber.by - rubber.ay);
    context.globalAlpha = 1;
    context.strokeStyle = colour('accent');
    context.lineWidth = 1;
    context.strokeRect(rubber.ax, rubber.ay, rubber.bx - rubber.ax, rubber.by - rubber.ay);
  }
}
