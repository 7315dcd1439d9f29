/// The layer below the data: grid, labels, gaps. Drawn afresh every time; it is small.
import { colour } from './colours';
import { plotHeight, plotWidth, xOf, type Geometry } from './geometry';
import { fraction, scaleTicks, tickLabel, ticks, type Scale } from './scale';

export const axisFont = "10.5px 'IBM Plex Mono', ui-monospace, monospace";

/** Sizes a canvas for the display's pixels and clears it. The context then works in CSS pixels. Null before layout. */
export function prepare(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
  const ratio = devicePixelRatio || 1;
  const w = Math.round(width * ratio);
  const h = Math.round(height * ratio);
  if (w < 1 || h < 1) return null;
  const context = canvas.getContext('2d');
  if (!context) return null;
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
}

export function drawTickAxis(context: CanvasRenderingContext2D, g: Geometry): void {
  context.font = axisFont;
  context.textBaseline = 'alphabetic';
  context.textAlign = 'center';
  context.lineWidth = 1;
  const bottom = g.height - g.bottom;
  for (const k of ticks(g.from, g.to, plotWidth(g) / 90).filter(Number.isInteger)) {
    const x = Math.round(xOf(g, k)) + 0.5;
    context.strokeStyle = colour('grid');
    context.beginPath();
    context.moveTo(x, g.top);
    context.lineTo(x, bottom);
    context.stroke();
    context.fillStyle = colour('muted');
    const text = tickLabel(k);
    const half = context.measureText(text).width / 2;
    if (x >= g.left - 4) context.fillText(text, Math.min(x, g.width - half - 1), g.height - 4);
  }
}

export function drawValueAxis(context: CanvasRenderingContext2D, g: Geometry, scale: Scale): void {
  context.font = axisFont;
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  context.lineWidth = 1;
  // A low plot has its labels closer together: one alone says no scale.
  for (const value of scaleTicks(scale, plotHeight(g) / (plotHeight(g) < 96 ? 18 : 32))) {
    const y = Math.round(g.height - g.bottom - fraction(scale, value) * plotHeight(g)) + 0.5;
    context.strokeStyle = colour(value === 0 && scale.lo < 0 && !scale.log ? 'control' : 'grid');
    context.beginPath();
    context.moveTo(g.left, y);
    context.lineTo(g.width - g.right, y);
    context.stroke();
    context.fillStyle = colour('muted');
    context.fillText(tickLabel(value), g.left - 6, y);
  }
}

/** Missing ticks: hatched, so that nobody reads them as quiet. */
export function drawGaps(context: CanvasRenderingContext2D, g: Geometry, gaps: readonly { from: number; to: number }[]): void {
  for (const gap of gaps) {
    const x = Math.max(g.left, xOf(g, gap.from));
    const end = Math.min(g.width - g.right, xOf(g, gap.to));
    if (end - x < 0.5) continue;
    context.save();
    context.beginPath();
    context.rect(x, g.top, end - x, plotHeight(g));
    context.clip();
    context.fillStyle = colour('grid');
    context.fillRect(x, g.top, end - x, plotHeight(g));
    context.strokeStyle = colour('control');
    context.lineWidth = 1;
    context.beginPath();
    for (let s = x - plotHeight(g); s < end; s += 6) {
      context.moveTo(s, g.height - g.bottom);
      context.lineTo(s + plotHeight(g), g.top);
    }
    context.stroke();
    context.restore();
  }
}
