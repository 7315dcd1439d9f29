/// Parallel coordinates: every trial a line over swept parameters and metrics.
import { colour } from '../../chart/colours';
import { fit, fraction, type Scale } from '../../chart/scale';
import { formatNumber } from '../../i18n/format.svelte';
import type { Brushes } from './brush';
import { valueAt } from './hits';
import { cut, rangeOf } from './plot';
import type { Hits, Mark, Scene } from './scene';
import { valueText } from './stats';

export interface ParallelAxis {
  /** A swept path, or a lane's metric. */
  name: string;
  /** Of a path that is not numeric: its values, one above the other. */
  words: string[] | null;
}

export interface TrialTable {
  axes: ParallelAxis[];
  /** Row by row, a row the trial of that index, an entry an axis; NaN where a trial has no value. */
  values: Float64Array;
  /** Cell of each row. */
  cells: Int32Array;
  rows: number;
  /** Trials a cell, and the seed of the first. */
  runs: number;
  firstSeed: number;
}

export const mostTrials = 10_000;

interface Placed extends ParallelAxis {
  x: number;
  scale: Scale;
}

/** Axes at their places in a drawing of this size. */
export interface Frame {
  axes: Placed[];
  top: number;
  bottom: number;
  width: number;
  height: number;
}

function scaleOf(table: TrialTable, i: number): Scale {
  const range = rangeOf(Array.from({ length: table.rows }, (_, row) => table.values[row * table.axes.length + i]!));
  return range && range.lo < range.hi ? { log: false, ...range } : fit(range, false);
}

/** `close`: brushed axes show the brush alone. */
export function frameOf(table: TrialTable, brushes: Brushes, close: boolean, width: number, height: number): Frame {
  const [left, right] = [14, width - 14];
  const count = table.axes.length;
  const axes = table.axes.map((axis, i): Placed => {
    const x = count === 1 ? (left + right) / 2 : left + (i / (count - 1)) * (right - left);
    const scale = axis.words ? { log: false, lo: -0.5, hi: Math.max(0.5, axis.words.length - 0.5) } : scaleOf(table, i);
    const brush = close ? brushes.get(axis.name) : undefined;
    const part = brush && { log: false, lo: Math.max(brush.lo, scale.lo), hi: Math.min(brush.hi, scale.hi) };
    return { ...axis, x, scale: part && part.lo < part.hi ? part : scale };
  });
  return { axes, top: 38, bottom: height - 20, width, height };
}

const yOf = ({ top, bottom }: Frame, scale: Scale, value: number): number => bottom - fraction(scale, value) * (bottom - top);

function axisMarks(frame: Frame, axis: Placed, brush: { lo: number; hi: number } | undefined): Mark[] {
  const { top, bottom, width } = frame;
  const y = (value: number): number => yOf(frame, axis.scale, value);
  const align = axis.x > width - 60 ? 'end' : axis.x < 60 ? 'start' : 'middle';
  const room = axis.x > width - 60 || axis.x < 60 ? 130 : 150;
  const ends: Mark[] = axis.words
    ? axis.words.map((word, i) => ({ type: 'text', x: axis.x + 4, y: y(i), text: cut(word, 60), fill: colour('ink') }))
    : [
        { type: 'text', x: axis.x, y: top - 8, text: formatNumber(axis.scale.hi), fill: colour('ink'), align },
        { type: 'text', x: axis.x, y: bottom + 9, text: formatNumber(axis.scale.lo), fill: colour('ink'), align },
      ];
  const bar: Mark[] = brush ? [{ type: 'rect', x: axis.x - 7, y: Math.max(top, y(brush.hi)), width: 14, height: Math.max(2, Math.min(bottom, y(brush.lo)) - Math.max(top, y(brush.hi))), fill: colour('accent'), alpha: 0.25, outline: colour('accent') }] : [];
  return [{ type: 'line', points: [axis.x, top, axis.x, bottom], colour: colour('ink'), width: 1.2 }, ...bar, { type: 'text', x: axis.x, y: top - 22, text: cut(axis.name, room), fill: colour('muted'), align }, ...ends];
}

export const axesMarks = (frame: Frame, brushes: Brushes): Mark[] => frame.axes.flatMap((axis) => axisMarks(frame, axis, brushes.get(axis.name)));

/** The points of some rows in one array. */
export function linesOf(table: TrialTable, frame: Frame, rows: Int32Array): Float32Array {
  const count = frame.axes.length;
  const points = new Float32Array(rows.length * count * 2);
  let at = 0;
  for (const row of rows) {
    for (let i = 0; i < count; i++) {
      points[at++] = frame.axes[i]!.x;
      points[at++] = yOf(frame, frame.axes[i]!.scale, table.values[row * count + i]!);
    }
  }
  return points;
}

/** How strong one of so many lines is. */
export const strengthOf = (rows: number): number => Math.max(0.04, Math.min(0.5, 60 / Math.max(1, rows)));

/** The whole picture in one list, for a file. */
export function parallelScene(table: TrialTable, rows: Int32Array, brushes: Brushes, close: boolean, width: number, height: number): Scene {
  const frame = frameOf(table, brushes, close, width, height);
  const all = Int32Array.from({ length: table.rows }, (_, row) => row);
  const whole = rows.length === table.rows;
  const each = frame.axes.length;
  return {
    width,
    height,
    marks: [
      ...(whole || close ? [] : [{ type: 'lines', points: linesOf(table, frame, all), each, colour: colour('control'), alpha: strengthOf(table.rows) } as Mark]),
      { type: 'lines', points: linesOf(table, frame, rows), each, colour: colour('accent'), alpha: strengthOf(rows.length) },
      ...axesMarks(frame, brushes),
    ],
  };
}

/** The trials of some rows; the nearest is looked for along the line between two axes. */
export function parallelHits(table: TrialTable, frame: Frame, rows: Int32Array, say: (row: number) => string): Hits {
  const count = frame.axes.length;
  const y = (row: number, i: number): number => yOf(frame, frame.axes[i]!.scale, table.values[row * count + i]!);
  const near = (px: number, py: number): number => {
    let left = 0;
    while (left < count - 2 && frame.axes[left + 1]!.x <= px) left++;
    const right = Math.min(count - 1, left + 1);
    const [ax, bx] = [frame.axes[left]!.x, frame.axes[right]!.x];
    const share = bx > ax ? Math.max(0, Math.min(1, (px - ax) / (bx - ax))) : 0;
    let best = -1;
    let least = 8;
    for (let i = 0; i < rows.length; i++) {
      const away = Math.abs((1 - share) * y(rows[i]!, left) + share * y(rows[i]!, right) - py);
      if (away < least) [best, least] = [i, away];
    }
    return best;
  };
  const at = (i: number): ReturnType<Hits['at']> => {
    const row = rows[i]!;
    const path = linesOf(table, frame, Int32Array.of(row));
    return { x: path[2 * count - 2]!, y: path[2 * count - 1]!, text: say(row), key: row, path };
  };
  return { count: rows.length, at, near };
}

/** The axis that a stroke of the pointer began on, and the values it covers. */
export function brushOf(frame: Frame, x: number, ay: number, by: number): { name: string; lo: number; hi: number } | null {
  const axis = frame.axes.find((one) => Math.abs(one.x - x) <= 18);
  if (!axis) return null;
  const share = (y: number): number => Math.max(0, Math.min(1, (frame.bottom - y) / (frame.bottom - frame.top)));
  return { name: axis.name, lo: valueAt(axis.scale, share(Math.max(ay, by))), hi: valueAt(axis.scale, share(Math.min(ay, by))) };
}

/** A trial with its values, in words. */
export function rowText({ axes, values }: TrialTable, row: number): string {
  return axes
    .map(({ name, words }, i) => {
      const value = values[row * axes.length + i]!;
      return `${name.split('.').slice(-2).join('.')} ${words?.[value] ?? formatNumber(value)}`;
    })
    .join(' · ');
}

export function parallelTable({ axes, values, cells, runs, firstSeed }: TrialTable, rows: Int32Array): { columns: string[]; rows: (string | number)[][] } {
  const cell = (value: number, axis: ParallelAxis): string | number => (Number.isNaN(value) ? '' : (axis.words?.[value] ?? value));
  return {
    columns: ['trial', 'seed', 'cell', ...axes.map((axis) => axis.name)],
    rows: Array.from(rows, (row) => [row, firstSeed + (row % runs), cells[row]!, ...axes.map((axis, i) => cell(values[row * axes.length + i]!, axis))]),
  };
}

/** A swept path as an axis: numbers as they are, anything else by its place among the values. */
export function pathAxis(path: string, values: readonly unknown[]): { axis: ParallelAxis; of: (value: unknown) => number } {
  if (values.every((value) => typeof value === 'number')) return { axis: { name: path, words: null }, of: (value) => value as number };
  const words = values.map((value) => valueText(value));
  return { axis: { name: path, words }, of: (value) => words.indexOf(valueText(value)) };
}
