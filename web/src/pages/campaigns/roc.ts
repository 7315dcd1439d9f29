/// Detection rate over false-alarm rate, and where each detector itself stood.
import type { Detection, RocCurve } from '../../api/campaigns';
import { colour, laneDash, laneToken } from '../../chart/colours';
import type { Scale } from '../../chart/scale';
import { formatNumber } from '../../i18n/format.svelte';
import { pointHits, zoomed } from './hits';
import { boxOf, place, xAxis, xTitle, yAxis, yTitle } from './plot';
import type { Hit, Mark, Scene, Zoom } from './scene';

export type RocBy = 'factor' | 'threshold';

/** So many curves in one picture; more would tell nothing apart. */
export const mostCurves = 16;

export const detectorName = ({ lane, node }: Pick<Detection, 'lane' | 'node'>): string => (node === null ? lane : `${lane} ${node}`);
export const curveOf = (one: Detection, by: RocBy): RocCurve => (by === 'factor' ? one.by_factor : one.by_threshold);

const unit: Scale = { log: false, lo: 0, hi: 1 };

interface RocWords {
  fpr: string;
  tpr: string;
  /** What the figure at a point of a curve is. */
  at: string;
}

/** Every point of every curve, in words. */
function hitsOf(detections: readonly Detection[], by: RocBy, words: RocWords, x: (value: number) => number, y: (value: number) => number): Hit[] {
  return detections.flatMap((one) =>
    curveOf(one, by).points.flatMap(([at, fpr, tpr]): Hit[] =>
      fpr === null || tpr === null ? [] : [{ x: x(fpr), y: y(tpr), text: `${detectorName(one)}: ${words.fpr} ${formatNumber(fpr)}, ${words.tpr} ${formatNumber(tpr)}; ${words.at} ${at === null ? '∞' : formatNumber(at)}` }],
    ),
  );
}

export function rocScene(detections: readonly Detection[], lanes: readonly string[], by: RocBy, words: RocWords, width: number, height: number, zoom: Zoom = {}): Scene {
  const box = boxOf(width, height, { left: 62, bottom: 38 });
  const [across, up] = [zoomed(unit, zoom.x), zoomed(unit, zoom.y)];
  const x = (value: number | null): number => (value === null ? NaN : place.x(box, across, value));
  const y = (value: number | null): number => (value === null ? NaN : place.y(box, up, value));
  const inside: Mark[] = [{ type: 'line', points: [x(0), y(0), x(1), y(1)], colour: colour('control'), dash: [2, 4] }];
  for (const one of detections) {
    const lane = Math.max(0, lanes.indexOf(one.lane));
    inside.push({ type: 'line', points: curveOf(one, by).points.flatMap(([, fpr, tpr]) => [x(fpr), y(tpr)]), colour: colour(laneToken(lane)), width: 1.8, dash: laneDash(lane) });
  }
  for (const { lane, own } of detections) {
    if (own.fpr === null || own.tpr === null) continue;
    inside.push({ type: 'dot', x: x(own.fpr), y: y(own.tpr), radius: 5, fill: colour('surface'), outline: colour(laneToken(Math.max(0, lanes.indexOf(lane)))) });
    inside.push({ type: 'dot', x: x(own.fpr), y: y(own.tpr), radius: 1.5, fill: colour('ink') });
  }
  const inBox = (hit: Hit): boolean => hit.x >= box.left && hit.x <= box.right && hit.y >= box.top && hit.y <= box.bottom;
  return {
    width,
    height,
    marks: [...yAxis(box, up), ...xAxis(box, across), xTitle(box, words.fpr), yTitle(box, words.tpr)],
    inside: { box, marks: inside },
    hits: pointHits(hitsOf(detections, by, words, x, y).filter(inBox)),
    axes: { box, x: across, y: up },
  };
}

export function rocTable(detections: readonly Detection[], by: RocBy): { columns: string[]; rows: (string | number)[][] } {
  const rows = detections.flatMap((one) => curveOf(one, by).points.map(([at, fpr, tpr]) => [one.lane, one.node ?? '', at ?? 'never', fpr ?? '', tpr ?? '']));
  return { columns: ['lane', 'node', by, 'fpr', 'tpr'], rows };
}
