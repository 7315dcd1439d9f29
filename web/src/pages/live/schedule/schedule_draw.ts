/// Attacks on sensors as bars over time, each with its letter.
import { colour } from '../../../chart/colours';
import { plotHeight, plotWidth, xOf, type Geometry } from '../../../chart/geometry';
import type { Series } from '../../../data/series';
import { stretches } from './stretches';

/** Top and height of every row, px. */
export function rowBoxes(g: Geometry, count: number): { y: number; height: number }[] {
  const each = plotHeight(g) / Math.max(1, count);
  const room = Math.min(3, each / 5);
  return Array.from({ length: count }, (_, i) => ({ y: g.top + i * each + room / 2, height: each - room }));
}

export function drawSchedule(context: CanvasRenderingContext2D, g: Geometry, rows: readonly Series[]): void {
  const boxes = rowBoxes(g, rows.length);
  const [left, right] = [g.left, g.width - g.right];
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  rows.forEach((series, i) => {
    const { y, height } = boxes[i]!;
    context.fillStyle = colour('grid');
    context.fillRect(left, y, plotWidth(g), height);
    context.font = `600 ${Math.min(11, height)}px 'IBM Plex Mono', monospace`;
    for (const { from, to, token, letter } of stretches(series)) {
      const x = Math.max(left, xOf(g, from - 0.5));
      const end = Math.min(right, xOf(g, to - 0.5));
      if (end <= x) continue;
      context.fillStyle = colour(token);
      context.fillRect(x, y, Math.max(1, end - x), height);
      if (!letter || height < 8 || end - x < 8 * letter.length + 4) continue;
      context.fillStyle = colour('surface');
      context.fillText(letter, (x + end) / 2, y + height / 2 + 0.5);
    }
  });
}
