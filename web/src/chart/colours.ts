/// The theme's colours for canvases, read once per theme.
import { theme } from '../theme/theme.svelte';

let known: { theme: string; values: Map<string, string> } | null = null;

/** The value of a custom property, e.g. colour('lane-0'). */
export function colour(name: string): string {
  if (known?.theme !== theme.shown) known = { theme: theme.shown, values: new Map() };
  let value = known.values.get(name);
  if (value === undefined) {
    value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim() || '#888888';
    known.values.set(name, value);
  }
  return value;
}

export const laneColours = 8;

/** The colour token of the lane at a position in the document. */
export function laneToken(index: number): string {
  return `lane-${((index % laneColours) + laneColours) % laneColours}`;
}

const dashes: readonly (readonly number[])[] = [[], [9, 3], [2, 3], [10, 3, 2, 3], [5, 3], [14, 4], [1, 2.5], [6, 2, 2, 2, 2, 2]];

/** A lane's second sign beside its colour: its dash, the same on every panel. It moves on where the colours begin anew, so that no two of 64 are alike. */
export function laneDash(index: number): number[] {
  const moved = index + Math.floor(index / laneColours);
  return [...dashes[((moved % dashes.length) + dashes.length) % dashes.length]!];
}

/** "#rrggbb", or "#rgb" as a minifier shortens it, as 0xAABBGGRR, the order of an ImageData seen as Uint32. */
export function packed(hex: string): number {
  const digits = hex.length === 4 ? [...hex.slice(1)].map((digit) => digit + digit).join('') : hex.slice(1, 7);
  const value = parseInt(digits, 16);
  if (Number.isNaN(value)) return 0xff888888;
  return ((0xff << 24) | ((value & 0xff) << 16) | (value & 0xff00) | (value >> 16)) >>> 0;
}
