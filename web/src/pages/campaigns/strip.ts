/// A strip of single trials: every value a dot, dots of like values upon each other.
import { colour } from '../../chart/colours';
import { fit } from '../../chart/scale';
import { boxOf, cut, place, rangeOf, xAxis, xTitle, type Box } from './plot';
import type { Mark, Scene } from './scene';

/** A bin of the strip, px. */
const kBin = 4;

export interface StripDot {
  index: number;
  x: number;
  y: number;
}

export interface Strip {
  scene: Scene;
  dots: StripDot[];
}

function dotsOf(box: Box, xs: { index: number; x: number }[]): StripDot[] {
  const bins = new Map<number, number>();
  const most = new Map<number, number>();
  for (const { x } of xs) most.set(Math.floor(x / kBin), (most.get(Math.floor(x / kBin)) ?? 0) + 1);
  const apart = Math.min(5, (box.bottom - box.top - 6) / Math.max(1, ...most.values()));
  return xs.map(({ index, x }) => {
    const bin = Math.floor(x / kBin);
    const above = bins.get(bin) ?? 0;
    bins.set(bin, above + 1);
    return { index, x, y: box.bottom - 4 - above * apart };
  });
}

/** `token`: the lane's colour. Outliers, listed first, are drawn hollow and in ink. */
export function stripOf(values: readonly { index: number; value: number }[], median: number | null, outliers: ReadonlySet<number>, metric: string, token: string, width: number, height: number): Strip {
  const box = boxOf(width, height, { left: 14, right: 14, bottom: 36 });
  const scale = fit(rangeOf(values.map((one) => one.value)), false);
  const dots = dotsOf(
    box,
    values.map(({ index, value }) => ({ index, x: place.x(box, scale, value) })),
  );
  const marks: Mark[] = [...xAxis(box, scale), xTitle(box, cut(metric, box.right - box.left))];
  if (median !== null) {
    const x = place.x(box, scale, median);
    marks.push({ type: 'line', points: [x, box.top, x, box.bottom], colour: colour('ink'), width: 1.5, dash: [6, 4] });
  }
  for (const { index, x, y } of dots) {
    if (outliers.has(index)) marks.push({ type: 'dot', x, y, radius: 3, fill: colour('surface'), outline: colour('ink') });
    else marks.push({ type: 'dot', x, y, radius: 2, fill: colour(token), alpha: 0.7 });
  }
  return { scene: { width, height, marks }, dots };
}

/** The trial whose dot is next to a place, within 8 px. */
export function dotAt(dots: readonly StripDot[], x: number, y: number): number | null {
  let best: number | null = null;
  let least = 8;
  for (const dot of dots) {
    const away = Math.hypot(dot.x - x, dot.y - y);
    if (away < least) [best, least] = [dot.index, away];
  }
  return best;
}
