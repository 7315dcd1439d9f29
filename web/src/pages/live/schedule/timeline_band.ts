/// The sensors' attacks over the whole run, as thin rows above the timeline's line: one a node.
import { colour } from '../../../chart/colours';
import { xOf, type Geometry } from '../../../chart/geometry';
import type { Series } from '../../../data/series';
import { sensorRasterCell } from './schedule_cells';

/** px that all rows together may take. */
const room = 14;

/** Stretches of one look, as ticks; a reduced point stands up to the next one. */
export function stretches(series: Series): { from: number; to: number; token: string }[] {
  const result: { from: number; to: number; token: string }[] = [];
  for (let i = 0; i < series.k.length; i++) {
    const several = series.lo[i] !== series.hi[i];
    const cell = Number.isNaN(series.hi[i]!) ? null : sensorRasterCell(series.hi[i]!, several);
    if (!cell) continue;
    const from = series.k[i]!;
    const next = series.k[i + 1];
    const to = next !== undefined && series.joined[i + 1] ? next : from + 1;
    const last = result.at(-1);
    if (last && last.token === cell.token && last.to >= from) last.to = to;
    else result.push({ from, to, token: cell.token });
  }
  return result;
}

/** Draws the rows from the top of the plot; answers the height they took. */
export function drawBand(context: CanvasRenderingContext2D, g: Geometry, rows: readonly Series[]): number {
  if (!rows.length) return 0;
  const each = Math.min(4, room / rows.length);
  rows.forEach((series, i) => {
    const y = g.top + 1 + i * each;
    for (const { from, to, token } of stretches(series)) {
      context.fillStyle = colour(token);
      context.fillRect(xOf(g, from - 0.5), y, Math.max(1, xOf(g, to - 0.5) - xOf(g, from - 0.5)), Math.max(1, each - (each > 2 ? 1 : 0)));
    }
  });
  return each * rows.length + 2;
}
