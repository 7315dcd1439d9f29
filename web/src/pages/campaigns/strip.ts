/// A strip of single trials: every value a dot, dots of like values upon each other.
import { colour } from '../../chart/colours';
import { fit } from '../../chart/scale';
import { pointHits, within, zoomed } from './hits';
import { boxOf, cut, place, rangeOf, xAxis, xTitle, type Box } from './plot';
import type { Hit, Mark, Scene, Zoom } from './scene';

/** A bin of the strip, px. */
const kBin = 4;

interface StripDot {
  index: number;
  value: number;
  x: number;
  y: number;
}

function dotsOf(box: Box, all: { index: number; value: number; x: number }[]): StripDot[] {
  const bins = new Map<number, number>();
  const most = new Map<number, number>();
  for (const { x } of all) most.set(Math.floor(x / kBin), (most.get(Math.floor(x / kBin)) ?? 0) + 1);
  let top = 1;
  for (const count of most.values()) top = Math.max(top, count);
  const apart = Math.min(5, (box.bottom - box.top - 6) / top);
  return all.map(({ index, value, x }) => {
    const bin = Math.floor(x / kBin);
    const above = bins.get(bin) ?? 0;
    bins.set(bin, above + 1);
    return { index, value, x, y: box.bottom - 4 - above * apart };
  });
}

export interface StripQuestion {
  values: readonly { index: number; value: number }[];
  median: number | null;
  /** Drawn hollow and in ink. */
  outliers: ReadonlySet<number>;
  metric: string;
  /** The lane's colour. */
  token: string;
  /** A trial in words. */
  say: (index: number, value: number) => string;
}

export function stripScene({ values, median, outliers, metric, token, say }: StripQuestion, width: number, height: number, zoom: Zoom = {}): Scene {
  const box = boxOf(width, height, { left: 14, right: 14, bottom: 36 });
  const scale = zoomed(fit(rangeOf(values.map((one) => one.value)), false), zoom.x);
  const shown = values.filter(({ value }) => within(scale, value));
  const dots = dotsOf(
    box,
    shown.map(({ index, value }) => ({ index, value, x: place.x(box, scale, value) })),
  );
  const marks: Mark[] = [...xAxis(box, scale), xTitle(box, cut(metric, box.right - box.left))];
  if (median !== null && within(scale, median)) {
    const x = place.x(box, scale, median);
    marks.push({ type: 'line', points: [x, box.top, x, box.bottom], colour: colour('ink'), width: 1.5, dash: [6, 4] });
  }
  marks.push({ type: 'dots', points: dots.flatMap(({ index, x, y }) => (outliers.has(index) ? [] : [x, y])), radius: 2, fill: colour(token), alpha: 0.7 });
  for (const { index, x, y } of dots) if (outliers.has(index)) marks.push({ type: 'dot', x, y, radius: 3, fill: colour('surface'), outline: colour('ink') });
  const places = dots.map(({ index, value, x, y }): Hit => ({ x, y, get text() { return say(index, value); }, key: index }));
  return { width, height, marks, hits: pointHits(places, 8), axes: { box, x: scale } };
}
