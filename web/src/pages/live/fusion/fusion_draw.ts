/// The rows of the fusion raster, and the sign over choices that were attacked.
import { colour } from '../../../chart/colours';
import { plotHeight, plotWidth, xOf, type Geometry } from '../../../chart/geometry';
import { rowSpans, ticksPerColumn, type RasterRow } from '../../../chart/raster';
import type { Series } from '../../../data/series';
import { sensorRasterCell } from '../schedule/schedule_cells';
import { attackedChoices, columnSeries, decode } from './fusion_cells';

export interface FusionRow {
  /** Id of the chooser, and its place among the nodes. */
  id: string;
  index: number;
  /** One code a tick. */
  codes: Series;
}

/** Rows of the raster for every node: its choices, below them what its own sensor suffered, a little room. */
const weights = [1, 0.34, 0.16] as const;

/** Width of one character of a cell's text, px. */
const characterWidth = 6.8;

/** px that a cell has for its text. */
function room(g: Geometry): number {
  return (plotWidth(g) * ticksPerColumn(g)) / Math.max(1, g.to - g.from) - 2;
}

export function fusionRows(g: Geometry, rows: readonly FusionRow[], nodes: readonly string[], tokens: readonly string[]): RasterRow[] {
  const per = ticksPerColumn(g);
  const from = Math.floor(g.from / per) * per;
  const columns = Math.ceil((g.to - from + 1) / per) + 1;
  const width = room(g);
  const fits = (text: string): string | undefined => (text.length * characterWidth <= width ? text : undefined);
  return rows.flatMap((row): RasterRow[] => {
    const series = columnSeries(row.codes, from, per, columns);
    return [
      { label: row.id, weight: weights[0], series, cell: (code) => choiceCell(code, row.index, nodes, tokens, fits) },
      { label: '', weight: weights[1], series, cell: (code) => ownCell(code, fits) },
      { label: '', weight: weights[2], series: none, cell: () => null },
    ];
  });
}

const none: Series = { k: new Float64Array(0), lo: new Float64Array(0), hi: new Float64Array(0), joined: new Uint8Array(0) };

type Cell = ReturnType<RasterRow['cell']>;

/** An attacked choice is ink; a choice of itself plain; another node that node's colour. */
export function choiceCell(code: number, self: number, nodes: readonly string[], tokens: readonly string[], fits: (text: string) => string | undefined): Cell {
  const { node, chosen } = decode(code);
  if (node < 0) return { token: chosen ? 'ink' : 'control' };
  const letter = fits(nodes[node] ?? '');
  if (chosen) return { token: 'ink', letter };
  return node === self ? { token: 'surface', letter, letterToken: 'muted' } : { token: tokens[node] ?? 'lane-0', letter };
}

export function ownCell(code: number, fits: (text: string) => string | undefined): Cell {
  const cell = sensorRasterCell(decode(code).own, false);
  return cell ? { token: cell.token, letter: cell.letter === undefined ? undefined : fits(cell.letter) } : null;
}

/** Hatches the cells whose choice was attacked: a sign beside their colour. */
export function hatchAttacked(context: CanvasRenderingContext2D, g: Geometry, rows: readonly RasterRow[]): void {
  const per = ticksPerColumn(g);
  const spans = rowSpans(g, rows);
  const lettered = room(g) >= characterWidth;
  context.save();
  context.strokeStyle = colour('surface');
  context.globalAlpha = 0.55;
  context.lineWidth = 1;
  for (let r = 0; r < rows.length; r += weights.length) {
    const { y, height } = spans[r]!;
    for (const span of attackedChoices(rows[r]!.series, per)) {
      const x = Math.max(g.left, xOf(g, span.from - 0.5));
      const width = Math.min(g.width - g.right, xOf(g, span.to + 0.5)) - x;
      if (width < 1) continue;
      context.save();
      context.beginPath();
      // A cell with text keeps its middle clear.
      const edge = lettered ? 0.27 * height : height;
      context.rect(x, y, width, edge);
      if (lettered) context.rect(x, y + height - edge, width, edge);
      context.clip();
      context.beginPath();
      // Lines stand at fixed places of the plot, so that a growing stretch does not move them.
      for (let s = g.left - plotHeight(g); s < x + width; s += 5) {
        if (s + height < x) continue;
        context.moveTo(s, y + height);
        context.lineTo(s + height, y);
      }
      context.stroke();
      context.restore();
    }
  }
  context.restore();
}
