/// A drawing's marks as SVG.
import type { Mark, Scene, Stroke } from './scene';

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
    case 'dots': {
      const dots = Array.from({ length: mark.points.length / 2 }, (_, i) => `<circle cx="${short(mark.points[2 * i]!)}" cy="${short(mark.points[2 * i + 1]!)}" r="${mark.radius}"/>`);
      return `<g ${fillText(mark.fill, mark.alpha)}>${dots.join('')}</g>`;
    }
    case 'text': {
      const turn = mark.turned ? ` transform="rotate(-90 ${short(mark.x)} ${short(mark.y)})"` : '';
      return `<text x="${short(mark.x)}" y="${short(mark.y)}" text-anchor="${mark.align ?? 'start'}" dominant-baseline="central" fill="${escaped(mark.fill)}"${turn}>${escaped(mark.text)}</text>`;
    }
  }
}

function insideText({ inside }: Scene): string[] {
  if (!inside) return [];
  const { left, right, top, bottom } = inside.box;
  const rect = `<rect x="${short(left - 4)}" y="${short(top - 4)}" width="${short(right - left + 8)}" height="${short(bottom - top + 8)}"/>`;
  return [`<clipPath id="inside">${rect}</clipPath>`, '<g clip-path="url(#inside)">', ...inside.marks.map(markText), '</g>'];
}

/** A file of its own, with the surface behind it and the title above. */
export function svgText(scene: Scene, title: string, surface: string, ink: string): string {
  const head = 24;
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${scene.width}" height="${scene.height + head}" viewBox="0 ${-head} ${scene.width} ${scene.height + head}" font-family="IBM Plex Mono, monospace" font-size="10.5">`,
    `<rect x="0" y="${-head}" width="100%" height="100%" fill="${escaped(surface)}"/>`,
    `<text x="8" y="-8" font-family="Inter, sans-serif" font-size="13" font-weight="600" fill="${escaped(ink)}">${escaped(title)}</text>`,
    ...scene.marks.map(markText),
    ...insideText(scene),
    '</svg>\n',
  ].join('\n');
}
