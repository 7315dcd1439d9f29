/// Two neighbouring releases as densities, and the privacy losses that the run drew against their exact law (seed 004, figures 3-6, 3-7, 4-4).
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { tickLabel, ticks } from '../../../chart/scale';
import { binsFor, histogramOf, summaryOf, type Histogram } from '../density/density';
import { normalDensity } from './normal';

export interface Curve {
  mean: number;
  deviation: number;
  token: string;
  dash: number[];
  word: string;
}

export interface Scene {
  from: number;
  to: number;
  most: number;
  curves: readonly Curve[];
  histogram: Histogram | null;
  /** A bound that is marked, and how it is called. */
  bound: { at: number; word: string } | null;
  token: string;
}

const reach = 3.6;

/** The picture of some laws, with samples behind them. */
export function sceneOf(curves: readonly Curve[], values: readonly number[], bound: Scene['bound'], token: string): Scene {
  const summary = summaryOf(values);
  const from = Math.min(...curves.map(({ mean, deviation }) => mean - reach * deviation), summary?.least ?? Infinity);
  const to = Math.max(...curves.map(({ mean, deviation }) => mean + reach * deviation), summary?.most ?? -Infinity, bound?.at ?? -Infinity);
  const histogram = summary ? histogramOf(values, from, to, binsFor(summary, from, to)) : null;
  const peaks = curves.map(({ mean, deviation }) => normalDensity(mean, mean, deviation));
  return { from, to, most: 1.08 * Math.max(...peaks, ...(histogram?.density ?? [])), curves, histogram, bound, token };
}

const frame = { left: 8, right: 8, top: 4, bottom: 18 };
const points = 160;

export function drawScene(context: CanvasRenderingContext2D, width: number, height: number, scene: Scene): void {
  const [w, h] = [width - frame.left - frame.right, height - frame.top - frame.bottom];
  const x = (value: number): number => frame.left + ((value - scene.from) / (scene.to - scene.from)) * w;
  const y = (density: number): number => frame.top + h * (1 - density / scene.most);
  drawAxis(context, width, height, scene, x);
  if (scene.histogram) drawBars(context, scene.histogram, scene.token, x, y);
  for (const curve of scene.curves) drawCurve(context, curve, scene, x, y);
  if (scene.bound) drawBound(context, scene.bound, height, x);
}

function drawAxis(context: CanvasRenderingContext2D, width: number, height: number, scene: Scene, x: (value: number) => number): void {
  context.font = axisFont;
  context.lineWidth = 1;
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  context.fillStyle = colour('muted');
  for (const value of ticks(scene.from, scene.to, width / 42)) {
    const at = Math.round(x(value)) + 0.5;
    context.strokeStyle = colour(value === 0 ? 'control' : 'grid');
    context.beginPath();
    context.moveTo(at, frame.top);
    context.lineTo(at, height - frame.bottom);
    context.stroke();
    context.fillText(tickLabel(value), Math.min(width - 14, Math.max(14, at)), height - 4);
  }
}

function drawBars(context: CanvasRenderingContext2D, { from, width, density }: Histogram, token: string, x: (value: number) => number, y: (density: number) => number): void {
  context.fillStyle = colour(token);
  context.globalAlpha = 0.28;
  density.forEach((value, i) => {
    const [x0, x1] = [x(from + i * width), x(from + (i + 1) * width)];
    context.fillRect(x0, y(value), Math.max(1, x1 - x0 - 0.5), y(0) - y(value));
  });
  context.globalAlpha = 1;
}

function drawCurve(context: CanvasRenderingContext2D, { mean, deviation, token, dash }: Curve, scene: Scene, x: (value: number) => number, y: (density: number) => number): void {
  context.strokeStyle = colour(token);
  context.lineWidth = 2;
  context.setLineDash(dash);
  context.beginPath();
  for (let i = 0; i < points; i++) {
    const value = scene.from + ((scene.to - scene.from) * i) / (points - 1);
    context.lineTo(x(value), y(normalDensity(value, mean, deviation)));
  }
  context.stroke();
  context.setLineDash([]);
}

function drawBound(context: CanvasRenderingContext2D, { at, word }: { at: number; word: string }, height: number, x: (value: number) => number): void {
  const place = Math.round(x(at)) + 0.5;
  context.strokeStyle = context.fillStyle = colour('ink');
  context.lineWidth = 1.2;
  context.setLineDash([2, 2]);
  context.beginPath();
  context.moveTo(place, frame.top);
  context.lineTo(place, height - frame.bottom);
  context.stroke();
  context.setLineDash([]);
  context.textAlign = 'right';
  context.textBaseline = 'top';
  context.fillText(word, place - 3, frame.top + 1);
}
