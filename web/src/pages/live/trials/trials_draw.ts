/// Running means against the number of runs.
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { tickLabel, ticks } from '../../../chart/scale';

export interface MeanLine {
  token: string;
  dash: readonly number[];
  width: number;
  values: readonly number[];
}

const frame = { left: 40, right: 8, top: 6, bottom: 18 };

/** The accuracies' range with a little room, inside [0, 1]. */
export function meanSpan(lines: readonly MeanLine[], level: number | null): { lo: number; hi: number } {
  const all = [...lines.flatMap((line) => [...line.values]), ...(level === null ? [] : [level])];
  if (!all.length) return { lo: 0, hi: 1 };
  const [lo, hi] = [Math.min(...all), Math.max(...all)];
  const room = Math.max(0.02, 0.08 * (hi - lo));
  return { lo: Math.max(0, lo - room), hi: Math.min(1, hi + room) };
}

export function drawMeans(context: CanvasRenderingContext2D, width: number, height: number, lines: readonly MeanLine[], level: number | null, count: number): void {
  const { lo, hi } = meanSpan(lines, level);
  const x = (n: number): number => frame.left + ((n - 1) / Math.max(1, count - 1)) * (width - frame.left - frame.right);
  const y = (value: number): number => height - frame.bottom - ((value - lo) / (hi - lo || 1)) * (height - frame.top - frame.bottom);
  context.font = axisFont;
  context.fillStyle = colour('muted');
  context.lineWidth = 1;
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  for (const value of ticks(lo, hi, height / 40)) {
    stroke(context, 'grid', 1, [], [[frame.left, Math.round(y(value)) + 0.5], [width - frame.right, Math.round(y(value)) + 0.5]]);
    context.fillText(tickLabel(value), frame.left - 6, y(value));
  }
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  for (const n of ticks(1, count, width / 80).filter((one) => Number.isInteger(one) && one >= 1)) context.fillText(tickLabel(n), Math.min(width - 10, x(n)), height - 4);
  if (level !== null) stroke(context, 'muted', 1.4, [3, 3], [[x(1), y(level)], [Math.max(x(count), x(1) + 12), y(level)]]);
  for (const line of lines) {
    const points = line.values.map((value, i): [number, number] => [x(i + 1), y(value)]);
    if (points.length > 1) stroke(context, line.token, line.width, line.dash, points);
    else if (points[0]) dot(context, points[0], line.token);
  }
}

function stroke(context: CanvasRenderingContext2D, token: string, width: number, dash: readonly number[], points: readonly (readonly [number, number])[]): void {
  context.strokeStyle = colour(token);
  context.lineWidth = width;
  context.lineJoin = 'round';
  context.setLineDash([...dash]);
  context.beginPath();
  for (const [px, py] of points) context.lineTo(px, py);
  context.stroke();
  context.setLineDash([]);
}

function dot(context: CanvasRenderingContext2D, [px, py]: readonly [number, number], token: string): void {
  context.beginPath();
  context.arc(px, py, 3, 0, 2 * Math.PI);
  context.fillStyle = colour(token);
  context.fill();
}
