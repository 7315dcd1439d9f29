/// Differences between lanes on the same draws, as points with their intervals.
import type { PairedDifference } from '../../api/campaigns';
import { colour, laneToken } from '../../chart/colours';
import { fit } from '../../chart/scale';
import { metricId } from './stats';
import { formatNumber } from '../../i18n/format.svelte';
import { pointHits, zoomed } from './hits';
import { boxOf, cut, place, rangeOf, xAxis, xTitle } from './plot';
import type { Hit, Mark, Scene, Zoom } from './scene';

/** Of one metric all differences `lane - base`: pairs that the server has the other way round are turned. */
export function againstBase(paired: readonly PairedDifference[], metric: string, base: string): PairedDifference[] {
  const less = (value: number | null): number | null => (value === null ? null : value === 0 ? 0 : -value);
  return paired.flatMap((one) => {
    if (metricId(one) !== metric) return [];
    if (one.base === base) return [one];
    if (one.lane !== base) return [];
    return [{ ...one, base, lane: one.base, mean: less(one.mean), lo: less(one.hi), hi: less(one.lo) }];
  });
}

export function basesOf(paired: readonly PairedDifference[], metric: string): string[] {
  return [...new Set(paired.flatMap((one) => (metricId(one) === metric ? [one.base, one.lane] : [])))];
}

export const rowHeight = 26;

export function pairedScene(rows: readonly PairedDifference[], lanes: readonly string[], title: string, width: number, height: number, zoom: Zoom = {}): Scene {
  const box = boxOf(width, height, { left: Math.min(150, width / 3), bottom: 38 });
  const scale = zoomed(fit(rangeOf([0, ...rows.flatMap((one) => [one.mean, one.lo, one.hi])]), false), zoom.x);
  const x = (value: number): number => place.x(box, scale, value);
  const zero = x(0);
  const marks: Mark[] = [...xAxis(box, scale), xTitle(box, cut(title, box.right - box.left))];
  const inside: Mark[] = [{ type: 'line', points: [zero, box.top, zero, box.bottom], colour: colour('ink'), width: 1.5, dash: [6, 4] }];
  const hits: Hit[] = [];
  rows.forEach((one, i) => {
    const y = box.top + (i + 0.5) * ((box.bottom - box.top) / rows.length);
    const token = colour(laneToken(Math.max(0, lanes.indexOf(one.lane))));
    marks.push({ type: 'text', x: box.left - 8, y, text: cut(one.lane, box.left - 16), fill: colour('ink'), align: 'end' });
    if (one.lo !== null && one.hi !== null) inside.push({ type: 'line', points: [x(one.lo), y, x(one.hi), y, NaN, NaN, x(one.lo), y - 5, x(one.lo), y + 5, NaN, NaN, x(one.hi), y - 5, x(one.hi), y + 5], colour: token, width: 1.8 });
    if (one.mean === null) return;
    inside.push({ type: 'dot', x: x(one.mean), y, radius: 3.5, fill: token });
    hits.push({ x: x(one.mean), y, text: `${one.lane} − ${one.base}: ${formatNumber(one.mean)} [${formatNumber(one.lo)}, ${formatNumber(one.hi)}]; p ${formatNumber(one.p, 2)}; n ${one.n}` });
  });
  return { width, height, marks, inside: { box, marks: inside }, hits: pointHits(hits.filter((hit) => hit.x >= box.left && hit.x <= box.right), 26), axes: { box, x: scale } };
}

export function pairedTable(rows: readonly PairedDifference[]): { columns: string[]; rows: (string | number)[][] } {
  return {
    columns: ['lane', 'base', 'metric', 'mean', 'se', 'lo', 'hi', 'p', 'n'],
    rows: rows.map((one) => [one.lane, one.base, metricId(one), one.mean ?? '', one.se ?? '', one.lo ?? '', one.hi ?? '', one.p ?? '', one.n]),
  };
}
