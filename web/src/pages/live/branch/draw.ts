import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { xOf, type Geometry } from '../../../chart/geometry';

/** Where the branches part: a line from top to bottom, with its word where there is room. */
export function drawFork(context: CanvasRenderingContext2D, g: Geometry, k: number, word: string): void {
  if (k < g.from || k > g.to) return;
  const x = Math.round(xOf(g, k)) + 0.5;
  context.save();
  context.strokeStyle = colour('accent');
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(x, g.top);
  context.lineTo(x, g.height - g.bottom);
  context.stroke();
  if (x < g.width - g.right - 34) {
    context.font = axisFont;
    context.textAlign = 'left';
    context.textBaseline = 'top';
    context.fillStyle = colour('accent');
    context.fillText(word, x + 3, g.top + 1);
  }
  context.restore();
}
