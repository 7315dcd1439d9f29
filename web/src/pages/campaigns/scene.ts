/// A drawing as a list of marks: the same list is painted on a canvas and written as SVG. CSS pixels.
import { axisFont } from '../../chart/axes';

export interface Stroke {
  colour: string;
  width?: number;
  dash?: readonly number[];
  alpha?: number;
}

export type Mark =
  | ({ type: 'line'; points: readonly number[] } & Stroke)
  /** Many lines of equally many points, all with the same stroke. */
  | ({ type: 'lines'; points: Float32Array; each: number } & Stroke)
  | { type: 'area'; points: readonly number[]; fill: string; alpha?: number }
  | { type: 'rect'; x: number; y: number; width: number; height: number; fill?: string; alpha?: number; outline?: string }
  | { type: 'dot'; x: number; y: number; radius: number; fill?: string; outline?: string; alpha?: number }
  | { type: 'text'; x: number; y: number; text: string; fill: string; align?: 'start' | 'middle' | 'end'; turned?: boolean };

export interface Scene {
  width: number;
  height: number;
  marks: Mark[];
}

/** Lines stroked in one go: where they overlap within it, their transparency does not add up. */
const kAtOnce = 25;

function trace(context: CanvasRenderingContext2D, points: ArrayLike<number>, from: number, to: number): void {
  let down = false;
  for (let i = from; i < to; i += 2) {
    const x = points[i]!;
    const y = points[i + 1]!;
    if (!Number.isFinite(x) || !Number.isFinite(y)) down = false;
    else if (down) context.lineTo(x, y);
    else {
      context.moveTo(x, y);
      down = true;
    }
  }
}

function stroke(context: CanvasRenderingContext2D, mark: Stroke): void {
  context.strokeStyle = mark.colour;
  context.lineWidth = mark.width ?? 1;
  context.setLineDash([...(mark.dash ?? [])]);
  context.stroke();
}

function paintLines(context: CanvasRenderingContext2D, mark: Extract<Mark, { type: 'lines' }>): void {
  const stride = 2 * mark.each;
  for (let from = 0; from < mark.points.length; from += stride * kAtOnce) {
    context.beginPath();
    for (let i = from; i < Math.min(from + stride * kAtOnce, mark.points.length); i += stride) trace(context, mark.points, i, i + stride);
    stroke(context, mark);
  }
}

function paintText(context: CanvasRenderingContext2D, mark: Extract<Mark, { type: 'text' }>): void {
  context.font = axisFont;
  context.fillStyle = mark.fill;
  context.textBaseline = 'middle';
  context.textAlign = mark.align === 'middle' ? 'center' : (mark.align ?? 'start');
  context.translate(mark.x, mark.y);
  if (mark.turned) context.rotate(-Math.PI / 2);
  context.fillText(mark.text, 0, 0);
}

function paintMark(context: CanvasRenderingContext2D, mark: Mark): void {
  context.globalAlpha = 'alpha' in mark && mark.alpha !== undefined ? mark.alpha : 1;
  if (mark.type === 'lines') return paintLines(context, mark);
  if (mark.type === 'text') return paintText(context, mark);
  context.beginPath();
  if (mark.type === 'line' || mark.type === 'area') trace(context, mark.points, 0, mark.points.length);
  if (mark.type === 'rect') context.rect(mark.x, mark.y, mark.width, mark.height);
  if (mark.type === 'dot') context.arc(mark.x, mark.y, mark.radius, 0, 2 * Math.PI);
  if (mark.type === 'line') return stroke(context, mark);
  if (mark.fill) {
    context.fillStyle = mark.fill;
    context.fill();
  }
  if ((mark.type === 'rect' || mark.type === 'dot') && mark.outline) stroke(context, { colour: mark.outline, width: 1.6 });
}

export function paint(context: CanvasRenderingContext2D, scene: Scene): void {
  for (const mark of scene.marks) {
    context.save();
    paintMark(context, mark);
    context.restore();
  }
}

const escaped = (text: string): string => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
const short = (value: number): string => String(Math.round(value * 100) / 100);

function pathOf(points: ArrayLike<number>, from: number, to: number): string {
  let text = '';
  let down = false;
  for (let i = from; i < to; i += 2) {
    const there = Number.isFinite(points[i]!) && Number.isFinite(points[i + 1]!);
    if (there) text += `${down ? 'L' : 'M'}${short(points[i]!)} ${short(points[i + 1]!)}`;
    down = there;
  }
  return text;
}

function strokeText(mark: Stroke): string {
  const dash = mark.dash?.length ? ` stroke-dasharray="${mark.dash.join(' ')}"` : '';
  const alpha = mark.alpha === undefined ? '' : ` stroke-opacity="${mark.alpha}"`;
  return `fill="none" stroke="${escaped(mark.colour)}" stroke-width="${mark.width ?? 1}"${dash}${alpha}`;
}

const fillText = (fill: string | undefined, alpha: number | undefined, outline?: string): string =>
  `fill="${escaped(fill ?? 'none')}"${alpha === undefined ? '' : ` fill-opacity="${alpha}"`}${outline ? ` stroke="${escaped(outline)}" stroke-width="1.6"` : ''}`;

function markText(mark: Mark): string {
  switch (mark.type) {
    case 'line':
      return `<path d="${pathOf(mark.points, 0, mark.points.length)}" ${strokeText(mark)}/>`;
    case 'lines': {
      const parts: string[] = [];
      for (let i = 0; i < mark.points.length; i += 2 * mark.each) parts.push(`<path d="${pathOf(mark.points, i, i + 2 * mark.each)}"/>`);
      return `<g ${strokeText(mark)}>${parts.join('')}</g>`;
    }
    case 'area':
      return `<path d="${pathOf(mark.points, 0, mark.points.length)}Z" ${fillText(mark.fill, mark.alpha)}/>`;
    case 'rect':
      return `<rect x="${short(mark.x)}" y="${short(mark.y)}" width="${short(mark.width)}" height="${short(mark.height)}" ${fillText(mark.fill, mark.alpha, mark.outline)}/>`;
    case 'dot':
      return `<circle cx="${short(mark.x)}" cy="${short(mark.y)}" r="${mark.radius}" ${fillText(mark.fill, mark.alpha, mark.outline)}/>`;
    case 'text': {
      const turn = mark.turned ? ` transform="rotate(-90 ${short(mark.x)} ${short(mark.y)})"` : '';
      return `<text x="${short(mark.x)}" y="${short(mark.y)}" text-anchor="${mark.align ?? 'start'}" dominant-baseline="central" fill="${escaped(mark.fill)}"${turn}>${escaped(mark.text)}</text>`;
    }
  }
}

/** A file of its own, with the surface behind it and the title above. */
export function svgText(scene: Scene, title: string, surface: string, ink: string): string {
  const head = 24;
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${scene.width}" height="${scene.height + head}" viewBox="0 ${-head} ${scene.width} ${scene.height + head}" font-family="IBM Plex Mono, monospace" font-size="10.5">`,
    `<rect x="0" y="${-head}" width="100%" height="100%" fill="${escaped(surface)}"/>`,
    `<text x="8" y="-8" font-family="Inter, sans-serif" font-size="13" font-weight="600" fill="${escaped(ink)}">${escaped(title)}</text>`,
    ...scene.marks.map(markText),
    '</svg>\n',
  ].join('\n');
}
