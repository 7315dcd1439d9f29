/// One metric of one lane over two swept parameters: colour for the mean, its number where there is room.
import type { CellSummary, Point } from '../../api/campaigns';
import { colour, laneToken } from '../../chart/colours';
import { formatNumber } from '../../i18n/format.svelte';
import { boxOf, cut, rangeOf, xTitle, yTitle, type Box } from './plot';
import type { Hit, Hits, Mark, Scene } from './scene';
import { cellAt, exactText, valueText, type Results, type SweptAxis } from './stats';

export interface SurfaceQuestion {
  results: Results;
  metric: string;
  lane: number;
  x: SweptAxis;
  y: SweptAxis;
  cells: readonly CellSummary[];
  point: Point;
}

export interface SurfaceCell {
  i: number;
  j: number;
  cell: number;
  mean: number | null;
}

export function surfaceCells({ results, metric, lane, x, y, cells, point }: SurfaceQuestion): SurfaceCell[] {
  return x.values.flatMap((xv, i) =>
    y.values.flatMap((yv, j) => {
      const found = cellAt(cells, { ...point, [x.path]: xv, [y.path]: yv });
      if (!found) return [];
      return [{ i, j, cell: found.cell, mean: results.of(metric, results.lanes[lane]!, found.cell)?.mean ?? null }];
    }),
  );
}

const boxFor = (width: number, height: number): Box => boxOf(width, height, { left: 84, right: 66, bottom: 38 });

function legend(box: Box, range: { lo: number; hi: number }, fill: string): Mark[] {
  const steps = 16;
  const tall = (box.bottom - box.top) / steps;
  const bar = Array.from({ length: steps }, (_, i): Mark => ({ type: 'rect', x: box.right + 8, y: box.bottom - (i + 1) * tall, width: 10, height: tall, fill, alpha: strength(i / (steps - 1)) }));
  return [
    ...bar,
    { type: 'text', x: box.right + 22, y: box.top + 6, text: formatNumber(range.hi), fill: colour('ink') },
    { type: 'text', x: box.right + 22, y: box.bottom - 6, text: formatNumber(range.lo), fill: colour('ink') },
  ];
}

const strength = (share: number): number => 0.04 + 0.66 * share;

function labels(box: Box, x: SweptAxis, y: SweptAxis, wide: number, tall: number): Mark[] {
  const everyX = Math.max(1, Math.ceil(52 / wide));
  const everyY = Math.max(1, Math.ceil(14 / tall));
  const across = x.values.flatMap((value, i): Mark[] => (i % everyX ? [] : [{ type: 'text', x: box.left + (i + 0.5) * wide, y: box.bottom + 10, text: cut(valueText(value), wide * everyX), fill: colour('muted'), align: 'middle' }]));
  const up = y.values.flatMap((value, j): Mark[] => (j % everyY ? [] : [{ type: 'text', x: box.left - 6, y: box.bottom - (j + 0.5) * tall, text: cut(valueText(value), 60), fill: colour('muted'), align: 'end' }]));
  return [...across, ...up, xTitle(box, cut(x.path, box.right - box.left)), yTitle(box, cut(y.path, box.bottom - box.top))];
}

export function surfaceScene(question: SurfaceQuestion, chosen: number, width: number, height: number): Scene {
  const { x, y, lane } = question;
  const box = boxFor(width, height);
  const wide = (box.right - box.left) / x.values.length;
  const tall = (box.bottom - box.top) / y.values.length;
  const cells = surfaceCells(question);
  const range = rangeOf(cells.map((one) => one.mean));
  const fill = colour(laneToken(lane));
  const marks: Mark[] = [];
  for (const { i, j, cell, mean } of cells) {
    // Whole px, so that no seam shows where two of them meet.
    const [left, right] = [Math.round(box.left + i * wide), Math.round(box.left + (i + 1) * wide)];
    const [top, bottom] = [Math.round(box.bottom - (j + 1) * tall), Math.round(box.bottom - j * tall)];
    const share = mean === null || !range ? null : range.hi > range.lo ? (mean - range.lo) / (range.hi - range.lo) : 0.5;
    if (share !== null) marks.push({ type: 'rect', x: left, y: top, width: right - left, height: bottom - top, fill, alpha: strength(share) });
    else marks.push({ type: 'line', points: [left, bottom, right, top], colour: colour('control') });
    if (wide > 44 && tall > 14) marks.push({ type: 'text', x: left + wide / 2, y: top + tall / 2, text: formatNumber(mean), fill: colour('ink'), align: 'middle' });
    if (cell === chosen) marks.push({ type: 'rect', x: left + 1, y: top + 1, width: wide - 2, height: tall - 2, outline: colour('ink') });
  }
  // What is chosen is drawn above its neighbours.
  marks.sort((a, b) => Number(a.type === 'rect' && a.outline !== undefined) - Number(b.type === 'rect' && b.outline !== undefined));
  return { width, height, marks: [...marks, ...(range ? legend(box, range, fill) : []), ...labels(box, x, y, wide, tall)], hits: hitsOf(question, cells, box) };
}

/** Column by column, each from below. */
function hitsOf({ x, y, metric, lane, results }: SurfaceQuestion, cells: readonly SurfaceCell[], box: Box): Hits {
  const [across, up] = [x.values.length, y.values.length];
  const [wide, tall] = [(box.right - box.left) / across, (box.bottom - box.top) / up];
  const at = (i: number): Hit => {
    const { i: column, j: row, cell, mean } = cells[i]!;
    const one = results.of(metric, results.lanes[lane]!, cell);
    const error = one?.se === null || one?.se === undefined ? '' : ` ± ${formatNumber(one.se, 2)}`;
    return { x: box.left + (column + 0.5) * wide, y: box.bottom - (row + 0.5) * tall, text: `${valueText(x.values[column])}, ${valueText(y.values[row])}: ${formatNumber(mean)}${error}`, key: cell };
  };
  const near = (px: number, py: number): number => {
    const [i, j] = [Math.floor((px - box.left) / wide), Math.floor((box.bottom - py) / tall)];
    return cells.findIndex((one) => one.i === i && one.j === j);
  };
  return { count: cells.length, at, near };
}

export function surfaceTable(question: SurfaceQuestion): { columns: string[]; rows: (string | number)[][] } {
  const { x, y, metric, results, lane } = question;
  const rows = surfaceCells(question).map(({ i, j, mean }) => [exactText(x.values[i]), exactText(y.values[j]), mean ?? '']);
  return { columns: [x.path, y.path, `${results.lanes[lane]}.${metric}`], rows };
}
