/// Means with standard errors and quantile bands, over a swept parameter or for the only point there is.
import type { CellSummary, Statistics } from '../../api/campaigns';
import { colour, laneDash, laneToken } from '../../chart/colours';
import { fit, type Scale } from '../../chart/scale';
import { formatNumber } from '../../i18n/format.svelte';
import { pointHits, zoomed } from './hits';
import { boxOf, cut, place, rangeOf, xAxis, xTick, xTitle, yAxis, yTitle, type Box } from './plot';
import type { Hit, Mark, Scene, Zoom } from './scene';
import { exactText, valueText, type Results, type SweptAxis } from './stats';

export type Band = 'wide' | 'half' | 'none';

export interface BandsQuestion {
  results: Results;
  metric: string;
  /** Lanes that are shown, by their place among all. */
  lanes: number[];
  /** null: one point alone. */
  axis: SweptAxis | null;
  /** In the order of the axis' values. */
  cells: (CellSummary | undefined)[];
  band: Band;
  log: boolean;
}

const ends: Record<Band, [string, string] | null> = { wide: ['0.05', '0.95'], half: ['0.25', '0.75'], none: null };

interface Line {
  lane: number;
  /** px from the value's place, so that bars of several lanes do not cover each other. */
  shift: number;
  items: (Statistics | undefined)[];
}

function linesOf({ results, metric, lanes, cells, axis }: BandsQuestion, width: number): Line[] {
  const apart = axis === null ? Math.min(80, (width - 90) / Math.max(1, lanes.length)) : 3;
  return lanes.map((lane, i) => ({
    lane,
    shift: (i - (lanes.length - 1) / 2) * apart,
    items: cells.map((cell) => (cell ? results.of(metric, results.lanes[lane]!, cell.cell) : undefined)),
  }));
}

function scaleOf(lines: Line[], band: Band, log: boolean): Scale {
  const pair = ends[band];
  const values = lines.flatMap(({ items }) =>
    items.flatMap((one) => {
      if (!one) return [];
      const { mean, se } = one;
      const bars = mean === null ? [] : [mean - (se ?? 0), mean + (se ?? 0), mean];
      return [...bars, ...(pair ? [one.quantiles[pair[0]], one.quantiles[pair[1]]] : [])];
    }),
  );
  const range = rangeOf(values, log);
  return fit(range, log && range !== null);
}

function bandMarks(line: Line, xs: number[], y: (value: number) => number, band: Band, wide: boolean): Mark[] {
  const pair = ends[band];
  if (!pair) return [];
  const fill = colour(laneToken(line.lane));
  const there = line.items.flatMap((one, i) => {
    const lo = one?.quantiles[pair[0]];
    const hi = one?.quantiles[pair[1]];
    return lo === null || lo === undefined || hi === null || hi === undefined ? [] : [{ x: xs[i]!, lo: y(lo), hi: y(hi) }];
  });
  if (there.length === 0) return [];
  if (wide || there.length === 1) return there.map(({ x, lo, hi }) => ({ type: 'rect', x: x + line.shift - 7, y: hi, width: 14, height: Math.max(1, lo - hi), fill, alpha: 0.22 }));
  const forth = there.flatMap(({ x, hi }) => [x, hi]);
  const back = [...there].reverse().flatMap(({ x, lo }) => [x, lo]);
  return [{ type: 'area', points: [...forth, ...back], fill, alpha: 0.13 }];
}

function lineMarks(line: Line, xs: number[], y: (value: number) => number, joined: boolean): Mark[] {
  const token = colour(laneToken(line.lane));
  const marks: Mark[] = [];
  const points = line.items.flatMap((one, i) => (one?.mean === null || one?.mean === undefined ? [NaN, NaN] : [xs[i]!, y(one.mean)]));
  if (joined) marks.push({ type: 'line', points, colour: token, width: 1.6, dash: laneDash(line.lane) });
  line.items.forEach((one, i) => {
    if (one?.mean === null || one?.mean === undefined) return;
    const x = xs[i]! + line.shift;
    if (one.se !== null) {
      const [top, bottom] = [y(one.mean + one.se), y(one.mean - one.se)];
      marks.push({ type: 'line', points: [x, top, x, bottom, NaN, NaN, x - 3, top, x + 3, top, NaN, NaN, x - 3, bottom, x + 3, bottom], colour: token, width: 1.4 });
    }
    marks.push({ type: 'dot', x, y: y(one.mean), radius: 2.6, fill: token });
    if (one.median !== null) marks.push({ type: 'dot', x, y: y(one.median), radius: 2.6, fill: colour('surface'), outline: token });
  });
  return marks;
}

interface Frame {
  xs: number[];
  marks: Mark[];
  /** Of numbers that are swept. */
  scale?: Scale;
}

function frame(box: Box, axis: SweptAxis | null, lines: Line[], lanes: readonly string[], zoom: Zoom): Frame {
  if (axis === null) {
    const x = (box.left + box.right) / 2;
    const marks = lines.map((line): Mark => ({ type: 'text', x: x + line.shift, y: box.bottom + 8, text: cut(lanes[line.lane]!, 82), fill: colour('muted'), align: 'end', turned: true }));
    return { xs: [x], marks };
  }
  const range = rangeOf(axis.at) ?? { lo: 0, hi: 1 };
  const room = (range.hi - range.lo || 1) * 0.04;
  const scale = zoomed({ log: false, lo: range.lo - room, hi: range.hi + room }, axis.numeric ? zoom.x : undefined);
  const xs = axis.at.map((value) => place.x(box, scale, value));
  const step = (box.right - box.left) / Math.max(1, axis.at.length);
  const ticks = axis.numeric ? xAxis(box, scale) : axis.values.flatMap((value, i) => xTick(box, xs[i]!, cut(valueText(value), step)));
  return { xs, marks: [...ticks, xTitle(box, cut(axis.path, box.right - box.left))], ...(axis.numeric ? { scale } : {}) };
}

/** Every point of every lane, in words. */
function hitsOf(lines: Line[], xs: number[], y: (value: number) => number, { results, axis, cells }: BandsQuestion): Hit[] {
  return lines.flatMap((line) =>
    line.items.flatMap((one, i): Hit[] => {
      if (one?.mean === null || one?.mean === undefined) return [];
      const at = axis ? `${valueText(axis.values[i])}: ` : '';
      const error = one.se === null ? '' : ` ± ${formatNumber(one.se, 2)}`;
      const middle = one.median === null ? '' : `; ${formatNumber(one.median)} [${formatNumber(one.quantiles['0.05'])}, ${formatNumber(one.quantiles['0.95'])}]`;
      return [{ x: xs[i]! + line.shift, y: y(one.mean), text: `${results.lanes[line.lane]}, ${at}${formatNumber(one.mean)}${error}${middle}; n ${one.n}`, key: cells[i]?.cell }];
    }),
  );
}

export function bandsScene(question: BandsQuestion, width: number, height: number, zoom: Zoom = {}): Scene {
  const lines = linesOf(question, width);
  const scale = zoomed(scaleOf(lines, question.band, question.log), zoom.y);
  const box = boxOf(width, height, { left: 66, bottom: question.axis === null ? 92 : 38 });
  const y = (value: number): number => place.y(box, scale, value);
  const below = frame(box, question.axis, lines, question.results.lanes, zoom);
  const joined = question.axis !== null;
  const inBox = ({ x, y: at }: Hit): boolean => x >= box.left && x <= box.right && at >= box.top && at <= box.bottom;
  return {
    width,
    height,
    marks: [...yAxis(box, scale), yTitle(box, cut(question.metric, box.bottom - box.top)), ...below.marks],
    inside: { box, marks: [...lines.flatMap((line) => bandMarks(line, below.xs, y, question.band, !joined)), ...lines.flatMap((line) => lineMarks(line, below.xs, y, joined))] },
    hits: pointHits(hitsOf(lines, below.xs, y, question).filter(inBox)),
    axes: { box, x: below.scale, y: scale },
  };
}

const kColumns = ['lane', 'n', 'mean', 'se', 'median', 'min', 'max', 'q0.05', 'q0.25', 'q0.75', 'q0.95'];

/** What is drawn, as rows of a file at full precision. */
export function bandsTable({ results, metric, lanes, axis, cells }: BandsQuestion): { columns: string[]; rows: (string | number)[][] } {
  const rows = cells.flatMap((cell, i) =>
    lanes.flatMap((lane) => {
      const one = cell && results.of(metric, results.lanes[lane]!, cell.cell);
      if (!one) return [];
      const q = (key: string): string | number => one.quantiles[key] ?? '';
      const swept = axis ? [exactText(axis.values[i])] : [];
      return [[...swept, one.lane, one.n, one.mean ?? '', one.se ?? '', one.median ?? '', one.min ?? '', one.max ?? '', q('0.05'), q('0.25'), q('0.75'), q('0.95')]];
    }),
  );
  return { columns: [...(axis ? [axis.path] : []), ...kColumns], rows };
}
