/// A panel of a figure as shapes of an SVG: scales that hold its series, paths broken at what has no place.
import type { FigurePanel, PanelAxis, PanelSeries } from '../../api/papers';
import { laneDash, laneToken } from '../../chart/colours';
import { fit, fraction, type Scale } from '../../chart/scale';

export const size = { width: 480, height: 300, left: 58, right: 12, top: 10, bottom: 42 };

export interface Frame {
  x: Scale;
  y: Scale;
}

const numbers = (list: readonly (number | null)[]): number[] => list.filter((value): value is number => value !== null && Number.isFinite(value));

/** Stems stand on zero. */
function scaleOf(axis: PanelAxis, lists: readonly (readonly (number | null)[])[], withZero: boolean, exact: boolean): Scale {
  const log = axis.scale === 'log';
  let lo = withZero && !log ? 0 : Infinity;
  let hi = withZero && !log ? 0 : -Infinity;
  for (const list of lists) {
    for (const value of numbers(list)) {
      if (log && value <= 0) continue;
      lo = Math.min(lo, value);
      hi = Math.max(hi, value);
    }
  }
  if (!(lo <= hi)) return fit(null, log);
  // A horizontal axis ends where the data ends: time has no room to spare.
  if (exact && lo < hi) return { log, lo, hi };
  return fit({ lo, hi }, log);
}

export function frameOf({ x, y, series }: FigurePanel): Frame {
  const drawn = series.filter((one) => one.style !== 'points');
  const stems = series.some((one) => one.style === 'stems');
  return {
    x: scaleOf(x, series.map((one) => one.x), false, drawn.length > 0),
    y: scaleOf(y, series.map((one) => one.y), stems, false),
  };
}

export const placeX = ({ x }: Frame, value: number): number => size.left + fraction(x, value) * (size.width - size.left - size.right);
export const placeY = ({ y }: Frame, value: number): number => size.height - size.bottom - fraction(y, value) * (size.height - size.top - size.bottom);

/** Where each point stands; null where it has no place. */
export function placesOf(series: PanelSeries, frame: Frame): ({ x: number; y: number } | null)[] {
  return series.x.map((x, i) => {
    const y = series.y[i];
    if (x === null || y === null || y === undefined) return null;
    const at = { x: placeX(frame, x), y: placeY(frame, y) };
    return Number.isFinite(at.x) && Number.isFinite(at.y) ? at : null;
  });
}

const px = (value: number): string => String(Math.round(value * 10) / 10);

/** A line, or steps, with a gap at each point that has no place. */
export function pathOf(series: PanelSeries, frame: Frame): string {
  let path = '';
  let open = false;
  for (const at of placesOf(series, frame)) {
    if (at === null) open = false;
    else if (open && series.style === 'steps') path += `H${px(at.x)}V${px(at.y)}`;
    else {
      path += `${open ? 'L' : 'M'}${px(at.x)} ${px(at.y)}`;
      open = true;
    }
  }
  return path;
}

/** Short lines from zero to each point. */
export function stemsOf(series: PanelSeries, frame: Frame): string {
  const zero = placeY(frame, frame.y.log ? frame.y.lo : 0);
  return placesOf(series, frame)
    .map((at) => (at ? `M${px(at.x)} ${px(zero)}V${px(at.y)}` : ''))
    .join('');
}

/** What the engine calls it. */
const truths: readonly string[] = ['truth', 'true'];

export interface Sign {
  token: string;
  dash: string;
  width: number;
  round: boolean;
}

/** Colour token, dash, width and the shape of the points; the truth is in ink as on every page. */
export function signOf(series: PanelSeries, index: number): Sign {
  const round = index % 2 === 0;
  if (series.style === 'edge') return { token: 'control', dash: '', width: 1.5, round };
  if (truths.includes(series.name) && series.style === 'line') return { token: 'ink', dash: '', width: 2.2, round };
  const own = laneDash(index);
  const dash = series.style === 'dashed' && own.length === 0 ? [5, 3] : own;
  return { token: laneToken(index), dash: dash.join(' '), width: 1.5, round };
}

/** A row a point: series, x, y. */
export function rowsOf(panel: FigurePanel): { columns: string[]; rows: (string | number)[][] } {
  const rows = panel.series.flatMap((series) => series.x.map((x, i) => [series.name, x ?? '', series.y[i] ?? '']));
  return { columns: ['series', panel.x.label || 'x', panel.y.label || 'y'], rows };
}
