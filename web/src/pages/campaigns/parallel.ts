/// Parallel coordinates: every trial a line over swept parameters and metrics.
import { colour, laneToken } from '../../chart/colours';
import { fit, fraction, type Scale } from '../../chart/scale';
import { formatNumber } from '../../i18n/format.svelte';
import { cut, rangeOf } from './plot';
import type { Mark, Scene } from './scene';
import { valueText } from './stats';

export interface ParallelAxis {
  /** A swept path, or a lane's metric. */
  name: string;
  /** Of a path that is not numeric: its values, one above the other. */
  words: string[] | null;
}

export interface TrialTable {
  axes: ParallelAxis[];
  /** Row by row, an entry an axis; NaN where a trial has no value. */
  values: Float64Array;
  /** Cell of each row. */
  cells: Int32Array;
  rows: number;
}

export const mostTrials = 10_000;

interface Placed extends ParallelAxis {
  x: number;
  scale: Scale;
}

function placed(table: TrialTable, left: number, right: number): Placed[] {
  const count = table.axes.length;
  return table.axes.map((axis, i) => {
    const x = count === 1 ? (left + right) / 2 : left + (i / (count - 1)) * (right - left);
    if (axis.words) return { ...axis, x, scale: { log: false, lo: -0.5, hi: Math.max(0.5, axis.words.length - 0.5) } };
    const column = Array.from({ length: table.rows }, (_, row) => table.values[row * count + i]!);
    const range = rangeOf(column);
    return { ...axis, x, scale: range && range.lo < range.hi ? { log: false, ...range } : fit(range, false) };
  });
}

function axisMarks(axis: Placed, top: number, bottom: number, width: number): Mark[] {
  const y = (value: number): number => bottom - fraction(axis.scale, value) * (bottom - top);
  const align = axis.x > width - 60 ? 'end' : axis.x < 60 ? 'start' : 'middle';
  const room = axis.x > width - 60 || axis.x < 60 ? 130 : 150;
  const ends: Mark[] = axis.words
    ? axis.words.map((word, i) => ({ type: 'text', x: axis.x + 4, y: y(i), text: cut(word, 60), fill: colour('ink') }))
    : [
        { type: 'text', x: axis.x, y: top - 8, text: formatNumber(axis.scale.hi), fill: colour('ink'), align },
        { type: 'text', x: axis.x, y: bottom + 9, text: formatNumber(axis.scale.lo), fill: colour('ink'), align },
      ];
  return [{ type: 'line', points: [axis.x, top, axis.x, bottom], colour: colour('ink'), width: 1.2 }, { type: 'text', x: axis.x, y: top - 22, text: cut(axis.name, room), fill: colour('muted'), align }, ...ends];
}

/** The points of the rows that are wanted, in one array. */
function linesOf(table: TrialTable, axes: readonly Placed[], top: number, bottom: number, wanted: (cell: number) => boolean): Float32Array {
  const count = axes.length;
  let rows = 0;
  for (let row = 0; row < table.rows; row++) if (wanted(table.cells[row]!)) rows++;
  const points = new Float32Array(rows * count * 2);
  let at = 0;
  for (let row = 0; row < table.rows; row++) {
    if (!wanted(table.cells[row]!)) continue;
    for (let i = 0; i < count; i++) {
      const value = table.values[row * count + i]!;
      points[at++] = axes[i]!.x;
      points[at++] = bottom - fraction(axes[i]!.scale, value) * (bottom - top);
    }
  }
  return points;
}

export function parallelScene(table: TrialTable, chosen: number, oneCell: boolean, width: number, height: number): Scene {
  const [top, bottom] = [38, height - 20];
  const axes = placed(table, 14, width - 14);
  const others = linesOf(table, axes, top, bottom, (cell) => oneCell || cell !== chosen);
  const own = oneCell ? new Float32Array() : linesOf(table, axes, top, bottom, (cell) => cell === chosen);
  const each = axes.length;
  const faint = Math.max(0.12, Math.min(0.5, 60 / Math.max(1, table.rows)));
  return {
    width,
    height,
    marks: [
      { type: 'lines', points: others, each, colour: colour(oneCell ? laneToken(0) : 'control'), alpha: faint },
      { type: 'lines', points: own, each, colour: colour('accent'), width: 1.2, alpha: 0.6 },
      ...axes.flatMap((axis) => axisMarks(axis, top, bottom, width)),
    ],
  };
}

export function parallelTable({ axes, values, cells, rows }: TrialTable): { columns: string[]; rows: (string | number)[][] } {
  const cell = (value: number, axis: ParallelAxis): string | number => (Number.isNaN(value) ? '' : (axis.words?.[value] ?? value));
  return {
    columns: ['cell', ...axes.map((axis) => axis.name)],
    rows: Array.from({ length: rows }, (_, row) => [cells[row]!, ...axes.map((axis, i) => cell(values[row * axes.length + i]!, axis))]),
  };
}

/** A swept path as an axis: numbers as they are, anything else by its place among the values. */
export function pathAxis(path: string, values: readonly unknown[]): { axis: ParallelAxis; of: (value: unknown) => number } {
  if (values.every((value) => typeof value === 'number')) return { axis: { name: path, words: null }, of: (value) => value as number };
  const words = values.map((value) => valueText(value));
  return { axis: { name: path, words }, of: (value) => words.indexOf(valueText(value)) };
}
