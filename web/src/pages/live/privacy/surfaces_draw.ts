/// Traces over the number of estimates in a mean, and over epsilon and delta (seed 004, figures 3-4 and 3-5).
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { fit, fraction, scaleTicks, tickLabel } from '../../../chart/scale';
import { formatNumber } from '../../../i18n/format.svelte';
import type { KappaCurve, Plane } from './design';

export interface KappaLine {
  values: readonly number[];
  token: string;
  dash: number[];
}

const room = { left: 44, right: 10, top: 6, bottom: 18 };

/** Lines over kappa; `level`: what no noise at all would leave. */
export function drawKappa(context: CanvasRenderingContext2D, width: number, height: number, kappas: readonly number[], lines: readonly KappaLine[], level: number | null): void {
  const all = [...lines.flatMap(({ values }) => [...values]), ...(level === null ? [] : [level])].filter((value) => value > 0);
  if (!all.length) return;
  const scale = fit({ lo: Math.min(...all), hi: Math.max(...all) }, true);
  const across = { log: true, lo: Math.max(1e-9, Math.min(...kappas)), hi: Math.max(...kappas) };
  const [right, bottom] = [width - room.right, height - room.bottom];
  const x = (kappa: number): number => room.left + (across.hi > across.lo ? fraction(across, kappa) : 0.5) * (right - room.left);
  const y = (value: number): number => bottom - fraction(scale, value) * (bottom - room.top);
  context.font = axisFont;
  context.lineWidth = 1;
  context.textBaseline = 'middle';
  context.textAlign = 'right';
  for (const value of scaleTicks(scale, (bottom - room.top) / 24)) {
    rule(context, room.left, y(value), right, y(value), 'grid');
    context.fillStyle = colour('muted');
    context.fillText(tickLabel(value), room.left - 5, y(value));
  }
  context.textBaseline = 'alphabetic';
  context.textAlign = 'center';
  for (const kappa of spread(kappas, x, 26)) {
    rule(context, x(kappa), room.top, x(kappa), bottom, 'grid');
    context.fillStyle = colour('muted');
    context.fillText(tickLabel(kappa), x(kappa), height - 4);
  }
  if (level !== null) stroke(context, [[room.left, y(level)], [right, y(level)]], 'ink', [1.5, 3]);
  for (const { values, token, dash } of lines) stroke(context, values.map((value, i) => [x(kappas[i]!), y(value)]), token, dash);
}

/** Those of some values whose places are at least `apart` px from the one before. */
function spread(values: readonly number[], x: (value: number) => number, apart: number): number[] {
  let last = -Infinity;
  return values.filter((value) => {
    if (x(value) - last < apart) return false;
    last = x(value);
    return true;
  });
}

function rule(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number, token: string): void {
  context.strokeStyle = colour(token);
  context.beginPath();
  context.moveTo(x0, Math.round(y0) + 0.5);
  context.lineTo(x1, Math.round(y1) + 0.5);
  context.stroke();
}

function stroke(context: CanvasRenderingContext2D, points: readonly (readonly [number, number])[], token: string, dash: number[]): void {
  context.strokeStyle = colour(token);
  context.lineWidth = 1.8;
  context.setLineDash(dash);
  context.beginPath();
  for (const [x, y] of points) context.lineTo(x, y);
  context.stroke();
  context.setLineDash([]);
}

export function extremes(matrix: readonly (readonly number[])[]): { least: number; most: number } {
  const all = matrix.flat().filter(Number.isFinite);
  return { least: Math.min(...all), most: Math.max(...all) };
}

/** Whether a surface falls wherever epsilon or delta grows. */
export function falls(matrix: readonly (readonly number[])[]): boolean {
  return matrix.every((row, i) => row.every((value, j) => (j === 0 || value < row[j - 1]!) && (i === 0 || value < matrix[i - 1]![j]!)));
}

/** How dark a cell is, by the logarithm of its value: the number in it stays legible. */
const darkest = 0.5;

/** Seen from above: a cell for every epsilon and delta, darker where more is left to guess, its number where there is room. */
export function drawPlane(context: CanvasRenderingContext2D, width: number, height: number, plane: Plane, which: 'pdfe' | 'cdfe', token: string, own: { epsilon: number | null; delta: number | null }): void {
  const matrix = plane[which];
  const { least, most } = extremes(matrix);
  const [w, h] = [(width - room.left - room.right) / plane.epsilon.length, (height - room.top - room.bottom - 2) / plane.delta.length];
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  const words = matrix.map((row) => row.map((value) => formatNumber(value, 2)));
  context.font = `${w < 34 ? 9 : 10}px 'IBM Plex Mono', monospace`;
  const fits = (word: string): boolean => h >= 12 && context.measureText(word).width < w - 2;
  plane.epsilon.forEach((_, i) =>
    plane.delta.forEach((__, j) => {
      const value = matrix[i]![j]!;
      const share = most > least ? Math.log(value / least) / Math.log(most / least) : 0;
      // Larger delta is further up.
      const [x, y] = [room.left + i * w, room.top + (plane.delta.length - 1 - j) * h];
      context.globalAlpha = 0.04 + darkest * Math.max(0, share);
      context.fillStyle = colour(token);
      context.fillRect(x, y, w - 1, h - 1);
      context.globalAlpha = 1;
      context.fillStyle = colour('ink');
      if (fits(words[i]![j]!)) context.fillText(words[i]![j]!, x + w / 2, y + h / 2);
    }),
  );
  drawOwn(context, plane, own, w, h);
  drawNames(context, height, plane, w, h);
}

/** Where a value is among growing ones, in steps of them and by its logarithm between two; null outside. */
export function indexOf(values: readonly number[], value: number): number | null {
  const above = values.findIndex((one) => one >= value);
  if (above < 0 || (above === 0 && values[0] !== value)) return null;
  if (values[above] === value) return above;
  const [a, b] = [values[above - 1]!, values[above]!];
  return above - 1 + Math.log(value / a) / Math.log(b / a);
}

/** A frame where the lane itself is. */
function drawOwn(context: CanvasRenderingContext2D, plane: Plane, own: { epsilon: number | null; delta: number | null }, w: number, h: number): void {
  const [i, j] = [own.epsilon === null ? null : indexOf(plane.epsilon, own.epsilon), own.delta === null ? null : indexOf(plane.delta, own.delta)];
  if (i === null || j === null) return;
  context.strokeStyle = colour('ink');
  context.lineWidth = 2;
  context.beginPath();
  context.roundRect(room.left + i * w - 1, room.top + (plane.delta.length - 1 - j) * h - 1, w + 1, h + 1, 3);
  context.stroke();
}

function drawNames(context: CanvasRenderingContext2D, height: number, plane: Plane, w: number, h: number): void {
  context.font = axisFont;
  context.fillStyle = colour('muted');
  const every = { x: Math.ceil(34 / w), y: Math.ceil(12 / h) };
  plane.epsilon.forEach((value, i) => {
    if (i % every.x === 0) context.fillText(formatNumber(value, 2), room.left + (i + 0.5) * w, height - 8);
  });
  context.textAlign = 'right';
  plane.delta.forEach((value, j) => {
    if (j % every.y === 0) context.fillText(tickLabel(value), room.left - 4, room.top + (plane.delta.length - 0.5 - j) * h);
  });
}

export function kappaWords(curve: KappaCurve, say: (values: Record<string, string>) => string): string {
  return curve.values.map((kappa, i) => say({ kappa: formatNumber(kappa), pdfe: formatNumber(curve.pdfe[i]), cdfe: formatNumber(curve.cdfe[i]) })).join('; ');
}
