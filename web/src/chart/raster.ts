/// Cells of rows by ticks: one colour a cell, its letter where there is room.
import { colour, packed } from './colours';
import { plotHeight, plotWidth, xOf, type Geometry } from './geometry';
import { axisFont } from './axes';
import type { Series } from '../data/series';

export interface RasterRow {
  label: string;
  series: Series;
  /** Colour token and letter of a value; null: leave the cell empty. */
  /** `several`: the value is the extreme of several ticks. */
  cell: (value: number, several: boolean) => { token: string; letter?: string; letterToken?: string } | null;
  /** Where a column holds several ticks the least value stands for it, not the greatest: one failure must show. */
  least?: boolean;
  /** Share of the row's height, from its top: a row can be a thin stripe. */
  weight?: number;
}

/**
 * One value a column for a window of `columns` columns from tick `from`: where a column holds several ticks the greatest
 * (or least) value stands for it. NaN: nothing known. `width` is ticks per column.
 */
export function columnsOf(series: Series, from: number, width: number, columns: number, least = false): Float64Array {
  const out = new Float64Array(columns).fill(NaN);
  for (let i = 0; i < series.k.length; i++) {
    const value = least ? series.lo[i]! : series.hi[i]!;
    if (Number.isNaN(value)) continue;
    const [begin, end] = ticksOf(series, i);
    const last = Math.floor((end - from) / width);
    for (let c = Math.max(0, Math.floor((begin - from) / width)); c <= Math.min(columns - 1, last); c++) {
      const known = out[c]!;
      if (Number.isNaN(known) || (least ? value < known : value > known)) out[c] = value;
    }
  }
  return out;
}

/** First and last tick that point i stands for: of reduced samples up to the next point, of a thinned frame back to the one before. */
function ticksOf(series: Series, i: number): [number, number] {
  const k = series.k[i]!;
  if (series.lo === series.hi) return [series.joined[i] ? Math.min(k, series.k[i - 1]! + 1) : k, k];
  const next = series.k[i + 1];
  return [k, next !== undefined && series.joined[i + 1] ? Math.max(k, next - 1) : k];
}

/** Ticks a column stands for: one while cells are at least 2 px wide, else as many as keep them so. */
export function ticksPerColumn(g: Geometry): number {
  return Math.max(1, Math.ceil((2 * (g.to - g.from)) / plotWidth(g)));
}

const scratch: { canvas: HTMLCanvasElement | null } = { canvas: null };

/** Draws all rows. A cell of tick k covers [k - 1/2, k + 1/2]. */
export function drawRaster(context: CanvasRenderingContext2D, g: Geometry, rows: readonly RasterRow[]): void {
  if (!rows.length) return;
  const per = ticksPerColumn(g);
  const from = Math.floor(g.from / per) * per;
  const columns = Math.ceil((g.to - from + 1) / per) + 1;
  const canvas = (scratch.canvas ??= document.createElement('canvas'));
  canvas.width = columns;
  canvas.height = rows.length;
  const inner = canvas.getContext('2d');
  if (!inner) return;
  const image = inner.createImageData(columns, rows.length);
  const pixels = new Uint32Array(image.data.buffer);
  const tokens = new Map<string, number>();
  const several = rows.map((row) => per > 1 || row.series.lo !== row.series.hi);
  const cells = rows.map((row) => columnsOf(row.series, from, per, columns, row.least));
  rows.forEach((row, r) => {
    for (let c = 0; c < columns; c++) {
      const value = cells[r]![c]!;
      const cell = Number.isNaN(value) ? null : row.cell(value, several[r]!);
      if (!cell) continue;
      let pixel = tokens.get(cell.token);
      if (pixel === undefined) tokens.set(cell.token, (pixel = packed(colour(cell.token))));
      pixels[r * columns + c] = pixel;
    }
  });
  inner.putImageData(image, 0, 0);
  paint(context, g, rows, cells, canvas, { from, per, columns });
}

function paint(
  context: CanvasRenderingContext2D,
  g: Geometry,
  rows: readonly RasterRow[],
  cells: readonly Float64Array[],
  canvas: HTMLCanvasElement,
  p: { from: number; per: number; columns: number },
): void {
  const left = xOf(g, p.from - 0.5);
  const right = xOf(g, p.from + p.columns * p.per - 0.5);
  const cellWidth = (right - left) / p.columns;
  const spans = rowSpans(g, rows);
  context.save();
  context.beginPath();
  context.rect(g.left, g.top, plotWidth(g), plotHeight(g));
  context.clip();
  context.imageSmoothingEnabled = false;
  rows.forEach((_, r) => {
    const span = spans[r]!;
    context.fillStyle = colour('grid');
    context.fillRect(g.left, span.y, plotWidth(g), span.height);
    context.drawImage(canvas, 0, r, p.columns, 1, left, span.y, right - left, span.height);
  });
  if (cellWidth >= 5) {
    context.fillStyle = colour('surface');
    for (let c = 0; c <= p.columns; c++) context.fillRect(Math.round(left + c * cellWidth) - 0.5, g.top, 1, plotHeight(g));
  }
  if (cellWidth >= 9) letters(context, rows, cells, spans, left, cellWidth, p.columns);
  context.restore();
}

function letters(
  context: CanvasRenderingContext2D,
  rows: readonly RasterRow[],
  cells: readonly Float64Array[],
  spans: readonly { y: number; height: number }[],
  left: number,
  cellWidth: number,
  columns: number,
): void {
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  rows.forEach((row, r) => {
    const span = spans[r]!;
    if (span.height < 7) return;
    context.font = `600 ${Math.min(11, span.height + 0.5)}px 'IBM Plex Mono', monospace`;
    for (let c = 0; c < columns; c++) {
      const value = cells[r]![c]!;
      const cell = Number.isNaN(value) ? null : row.cell(value, row.series.lo !== row.series.hi);
      if (!cell?.letter) continue;
      context.fillStyle = colour(cell.letterToken ?? 'surface');
      context.fillText(cell.letter, left + (c + 0.5) * cellWidth, span.y + span.height / 2 + 0.5);
    }
  });
}

/** Top and height of every row, one pixel between them. */
export function rowSpans(g: Geometry, rows: readonly { weight?: number }[]): { y: number; height: number }[] {
  const total = rows.reduce((sum, row) => sum + (row.weight ?? 1), 0) || 1;
  const unit = plotHeight(g) / total;
  let y = g.top;
  return rows.map((row) => {
    const height = unit * (row.weight ?? 1);
    const span = { y: Math.round(y), height: Math.max(1, Math.round(y + height) - Math.round(y) - (height > 3 ? 1 : 0)) };
    y += height;
    return span;
  });
}

/** Row names at the left; where rows are too low for text, every second, third … */
export function drawRowLabels(context: CanvasRenderingContext2D, g: Geometry, rows: readonly RasterRow[]): void {
  const spans = rowSpans(g, rows);
  context.font = axisFont;
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  context.fillStyle = colour('muted');
  let free = -Infinity;
  rows.forEach((row, r) => {
    const middle = spans[r]!.y + spans[r]!.height / 2;
    if (!row.label || middle - free < 10.5) return;
    context.fillText(row.label, g.left - 6, middle + 0.5);
    free = middle;
  });
}
