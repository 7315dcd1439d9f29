/// Densities of one component's error: the chosen lane as bars and a line, the other as a dashed line.
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { niceStep, tickLabel, ticks } from '../../../chart/scale';
import { binsFor, histogramOf, smoothOf, spanOf, type Histogram, type Summary } from './density';

export interface ErrorSet {
  token: string;
  dash: readonly number[];
  values: readonly number[];
  summary: Summary;
}

export interface Shape {
  from: number;
  to: number;
  most: number;
  histograms: Histogram[];
  lines: Float64Array[];
}

const points = 160;

export function shapeOf(sets: readonly ErrorSet[]): Shape | null {
  const span = spanOf(sets.map((set) => set.summary));
  if (!span) return null;
  const { from, to } = span;
  const bins = Math.max(...sets.map((set) => binsFor(set.summary, from, to)));
  const histograms = sets.map((set) => histogramOf(set.values, from, to, bins));
  const lines = sets.map((set) => smoothOf(set.values, set.summary, from, to, points));
  const peak = Math.max(...histograms.flatMap(({ density }) => [...density]), ...lines.flatMap((line) => [...line]));
  return { from, to, most: peak > 0 ? peak * 1.06 : 1, histograms, lines };
}

const frame = { left: 40, right: 8, top: 4, bottom: 18 };

export function drawDensity(context: CanvasRenderingContext2D, width: number, height: number, sets: readonly ErrorSet[], shape: Shape): void {
  const [w, h] = [width - frame.left - frame.right, height - frame.top - frame.bottom];
  const x = (value: number): number => frame.left + ((value - shape.from) / (shape.to - shape.from)) * w;
  const y = (density: number): number => frame.top + h * (1 - density / shape.most);
  axes(context, width, height, shape, x, y);
  sets.forEach((set, s) => bars(context, set, shape.histograms[s]!, s > 0, x, y));
  sets.forEach((set, s) => {
    const line = shape.lines[s]!;
    context.strokeStyle = colour(set.token);
    context.lineWidth = s === 0 ? 2 : 1.6;
    context.setLineDash(s === 0 ? [] : set.dash.length ? [...set.dash] : [5, 3]);
    context.beginPath();
    line.forEach((density, i) => context.lineTo(x(shape.from + ((shape.to - shape.from) * i) / (points - 1)), y(density)));
    context.stroke();
    context.setLineDash([]);
  });
}

function axes(context: CanvasRenderingContext2D, width: number, height: number, shape: Shape, x: (value: number) => number, y: (density: number) => number): void {
  context.font = axisFont;
  context.lineWidth = 1;
  context.fillStyle = colour('muted');
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  const rule = (x0: number, y0: number, x1: number, y1: number, token: string): void => {
    context.strokeStyle = colour(token);
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
  };
  for (const value of ticks(shape.from, shape.to, width / 70)) {
    const at = Math.round(x(value)) + 0.5;
    rule(at, frame.top, at, height - frame.bottom, value === 0 ? 'control' : 'grid');
    context.fillText(tickLabel(value), Math.min(width - 12, at), height - 4);
  }
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  const step = niceStep(shape.most / Math.max(2, (height - 22) / 34));
  for (let density = 0; density <= shape.most; density += step) {
    const at = Math.round(y(density)) + 0.5;
    rule(frame.left, at, width - frame.right, at, 'grid');
    context.fillStyle = colour('muted');
    context.fillText(tickLabel(Number(density.toPrecision(6))), frame.left - 6, at);
  }
}

/** The first set's bars are filled, the other's only outlined: both can be seen through each other. */
function bars(context: CanvasRenderingContext2D, set: ErrorSet, histogram: Histogram, outline: boolean, x: (value: number) => number, y: (density: number) => number): void {
  context.fillStyle = context.strokeStyle = colour(set.token);
  context.globalAlpha = outline ? 0.5 : 0.25;
  context.lineWidth = 1;
  context.beginPath();
  histogram.density.forEach((density, i) => {
    const [x0, x1] = [x(histogram.from + i * histogram.width), x(histogram.from + (i + 1) * histogram.width)];
    if (outline) {
      context.lineTo(x0, y(density));
      context.lineTo(x1, y(density));
    } else context.fillRect(x0, y(density), Math.max(1, x1 - x0 - 0.5), y(0) - y(density));
  });
  if (outline) context.stroke();
  context.globalAlpha = 1;
}
