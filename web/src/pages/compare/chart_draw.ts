/// The picture of one signal: every run's line, and where one of them leaves the tolerance.
import { drawTickAxis, drawValueAxis } from '../../chart/axes';
import { colour } from '../../chart/colours';
import { plotHeight, xOf, type Geometry } from '../../chart/geometry';
import { tableOf } from '../../chart/held_chart';
import { extent, fit, fraction } from '../../chart/scale';
import type { Series } from '../../data/series';
import { runLook } from './read';

/** Height of the strip above the plot in which a run shows where it is outside, px. */
const kStrip = 4;

/** Room for the strips of so many runs, px. */
export function strips(runs: number): number {
  return runs * (kStrip + 1);
}

export interface Outside {
  /** Place of the run among those compared. */
  run: number;
  stretches: readonly [number, number][];
}

function rectangle(context: CanvasRenderingContext2D, g: Geometry, from: number, to: number, y: number, height: number): void {
  const x = Math.max(g.left, xOf(g, from - 0.5));
  const end = Math.min(g.width - g.right, xOf(g, to + 0.5));
  if (end > x) context.fillRect(x, y, Math.max(1, end - x), height);
}

export function drawOutside(context: CanvasRenderingContext2D, g: Geometry, any: readonly [number, number][], each: readonly Outside[]): void {
  context.save();
  context.fillStyle = colour('bad');
  context.globalAlpha = 0.1;
  for (const [from, to] of any) rectangle(context, g, from, to, g.top, plotHeight(g));
  context.globalAlpha = 1;
  each.forEach(({ run, stretches }, i) => {
    context.fillStyle = colour(runLook(run).token);
    for (const [from, to] of stretches) rectangle(context, g, from, to, g.top - strips(each.length - i), kStrip);
  });
  context.restore();
}

function drawLine(context: CanvasRenderingContext2D, g: Geometry, series: Series, steps: boolean, y: (value: number) => number): void {
  const [ticks, values] = tableOf(series, false);
  context.beginPath();
  let down = false;
  ticks.forEach((k, i) => {
    const value = values[i];
    if (value === null || value === undefined) {
      down = false;
      return;
    }
    if (down && steps) context.lineTo(xOf(g, k), y(values[i - 1]!));
    if (down) context.lineTo(xOf(g, k), y(value));
    else context.moveTo(xOf(g, k), y(value));
    down = true;
  });
  context.stroke();
}

/** The base first and wide: what agrees with it lies upon it, both in sight. `steps`: a value holds until the next. */
export function drawRuns(context: CanvasRenderingContext2D, g: Geometry, all: readonly Series[], steps: boolean): void {
  const scale = fit(extent(all, g.from, g.to, false), false);
  drawTickAxis(context, g);
  drawValueAxis(context, g, scale);
  context.save();
  context.beginPath();
  context.rect(g.left, g.top, g.width - g.left - g.right, plotHeight(g));
  context.clip();
  const y = (value: number): number => g.height - g.bottom - fraction(scale, value) * plotHeight(g);
  all.forEach((series, i) => {
    const look = runLook(i);
    context.strokeStyle = colour(look.token);
    context.lineWidth = look.width;
    context.setLineDash(look.dash);
    drawLine(context, g, series, steps, y);
  });
  context.restore();
}
