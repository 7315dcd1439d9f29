/// Where things are in a plot whose horizontal axis is the tick. CSS pixels.
export interface Geometry {
  width: number;
  height: number;
  left: number;
  right: number;
  top: number;
  bottom: number;
  /** Ticks at the left and right edge. */
  from: number;
  to: number;
}

export function plotWidth(g: Geometry): number {
  return Math.max(1, g.width - g.left - g.right);
}

export function plotHeight(g: Geometry): number {
  return Math.max(1, g.height - g.top - g.bottom);
}

export function xOf(g: Geometry, k: number): number {
  return g.left + ((k - g.from) / (g.to - g.from || 1)) * plotWidth(g);
}

/** The tick under a horizontal position, not rounded. */
export function kOf(g: Geometry, x: number): number {
  return g.from + ((x - g.left) / plotWidth(g)) * (g.to - g.from);
}

/** A window scaled by `factor` (below 1: nearer) about tick `at`, kept inside [0, head] and at least 4 ticks wide. */
export function zoomed(from: number, to: number, factor: number, at: number, head: number): { from: number; to: number } {
  const width = Math.min(Math.max(4, (to - from) * factor), Math.max(4, head));
  const share = (at - from) / (to - from || 1);
  return kept(at - share * width, width, head);
}

/** A window moved by `by` ticks, kept inside [0, head]. */
export function moved(from: number, to: number, by: number, head: number): { from: number; to: number } {
  return kept(from + by, to - from, head);
}

function kept(from: number, width: number, head: number): { from: number; to: number } {
  const start = Math.round(Math.max(0, Math.min(from, head - width)));
  return { from: start, to: start + Math.round(width) };
}
