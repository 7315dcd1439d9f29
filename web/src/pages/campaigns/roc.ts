/// Detection rate over false-alarm rate, and where each detector itself stood.
import type { Detection, RocCurve } from '../../api/campaigns';
import { colour, laneDash, laneToken } from '../../chart/colours';
import type { Scale } from '../../chart/scale';
import { boxOf, place, xAxis, xTitle, yAxis, yTitle } from './plot';
import type { Mark, Scene } from './scene';

export type RocBy = 'factor' | 'threshold';

/** So many curves in one picture; more would tell nothing apart. */
export const mostCurves = 16;

export const detectorName = ({ lane, node }: Pick<Detection, 'lane' | 'node'>): string => (node === null ? lane : `${lane} ${node}`);
export const curveOf = (one: Detection, by: RocBy): RocCurve => (by === 'factor' ? one.by_factor : one.by_threshold);

const unit: Scale = { log: false, lo: 0, hi: 1 };

export function rocScene(detections: readonly Detection[], lanes: readonly string[], by: RocBy, words: { fpr: string; tpr: string }, width: number, height: number): Scene {
  const box = boxOf(width, height, { left: 62, bottom: 38 });
  const x = (value: number | null): number => (value === null ? NaN : place.x(box, unit, value));
  const y = (value: number | null): number => (value === null ? NaN : place.y(box, unit, value));
  const marks: Mark[] = [
    ...yAxis(box, unit),
    ...xAxis(box, unit),
    xTitle(box, words.fpr),
    yTitle(box, words.tpr),
    { type: 'line', points: [x(0), y(0), x(1), y(1)], colour: colour('control'), dash: [2, 4] },
  ];
  for (const one of detections) {
    const lane = Math.max(0, lanes.indexOf(one.lane));
    marks.push({ type: 'line', points: curveOf(one, by).points.flatMap(([, fpr, tpr]) => [x(fpr), y(tpr)]), colour: colour(laneToken(lane)), width: 1.8, dash: laneDash(lane) });
  }
  for (const { lane, own } of detections) {
    if (own.fpr === null || own.tpr === null) continue;
    marks.push({ type: 'dot', x: x(own.fpr), y: y(own.tpr), radius: 5, fill: colour('surface'), outline: colour(laneToken(Math.max(0, lanes.indexOf(lane)))) });
    marks.push({ type: 'dot', x: x(own.fpr), y: y(own.tpr), radius: 1.5, fill: colour('ink') });
  }
  return { width, height, marks };
}

export function rocTable(detections: readonly Detection[], by: RocBy): { columns: string[]; rows: (string | number)[][] } {
  const rows = detections.flatMap((one) => curveOf(one, by).points.map(([at, fpr, tpr]) => [one.lane, one.node ?? '', at ?? 'never', fpr ?? '', tpr ?? '']));
  return { columns: ['lane', 'node', by, 'fpr', 'tpr'], rows };
}
