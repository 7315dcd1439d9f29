/// The sensors' attacks over the whole run, as thin rows above the timeline's line: one a node.
import { colour } from '../../../chart/colours';
import { xOf, type Geometry } from '../../../chart/geometry';
import type { Series } from '../../../data/series';
import { stretches } from './stretches';

/** px that all rows together may take. */
const room = 14;

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
