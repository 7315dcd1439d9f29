/// Finding what is under the pointer, and scales that are zoomed.
import type { Scale } from '../../chart/scale';
import { fraction } from '../../chart/scale';
import type { Box } from './plot';
import type { Hit, Hits, Zoom } from './scene';

/** How near a pointer must be, px. */
const kReach = 16;

/** Places with values. The keyboard goes from left to right. */
export function pointHits(places: readonly Hit[], reach = kReach): Hits {
  const order = places.map((_, i) => i).sort((a, b) => places[a]!.x - places[b]!.x || places[a]!.y - places[b]!.y);
  return {
    count: places.length,
    at: (i) => places[order[i]!]!,
    near: (x, y) => {
      let best = -1;
      let least = reach;
      order.forEach((place, i) => {
        const away = Math.hypot(places[place]!.x - x, places[place]!.y - y);
        if (away < least) [best, least] = [i, away];
      });
      return best;
    },
  };
}

export const noHits: Hits = { count: 0, at: () => ({ x: 0, y: 0, text: '' }), near: () => -1 };

export function zoomed(scale: Scale, part: { lo: number; hi: number } | undefined): Scale {
  return part ? { log: scale.log, lo: part.lo, hi: part.hi } : scale;
}

/** The value at a share of a scale: the inverse of fraction(). */
export function valueAt(scale: Scale, share: number): number {
  if (scale.log) return 10 ** (Math.log10(scale.lo) + share * (Math.log10(scale.hi) - Math.log10(scale.lo)));
  return scale.lo + share * (scale.hi - scale.lo);
}

const clamped = (value: number): number => Math.max(0, Math.min(1, value));

/** What a rectangle of the drawing, two opposite corners of it, covers; null where it is too small to be meant. */
export function zoomOf(axes: { box: Box; x?: Scale; y?: Scale }, ax: number, ay: number, bx: number, by: number): Zoom | null {
  const { box, x, y } = axes;
  const part = (scale: Scale, a: number, b: number): { lo: number; hi: number } => ({ lo: valueAt(scale, clamped(Math.min(a, b))), hi: valueAt(scale, clamped(Math.max(a, b))) });
  const across = (at: number): number => (at - box.left) / (box.right - box.left);
  const up = (at: number): number => (box.bottom - at) / (box.bottom - box.top);
  const wide = x && Math.abs(bx - ax) >= 8 ? part(x, across(ax), across(bx)) : undefined;
  const tall = y && Math.abs(by - ay) >= 8 ? part(y, up(ay), up(by)) : undefined;
  const there = (one: { lo: number; hi: number } | undefined): boolean => one !== undefined && one.lo < one.hi;
  if (!there(wide) && !there(tall)) return null;
  return { ...(there(wide) ? { x: wide } : {}), ...(there(tall) ? { y: tall } : {}) };
}

/** Closer to a place (factor below 1), or farther away. */
export function zoomAround(axes: { box: Box; x?: Scale; y?: Scale }, px: number, py: number, factor: number): Zoom {
  const { box, x, y } = axes;
  const part = (scale: Scale, at: number): { lo: number; hi: number } => ({ lo: valueAt(scale, at - factor * at), hi: valueAt(scale, at + factor * (1 - at)) });
  return {
    ...(x ? { x: part(x, clamped((px - box.left) / (box.right - box.left))) } : {}),
    ...(y ? { y: part(y, clamped((box.bottom - py) / (box.bottom - box.top))) } : {}),
  };
}

export const within = (scale: Scale, value: number): boolean => {
  const share = fraction(scale, value);
  return share >= -1e-9 && share <= 1 + 1e-9;
};
