/// The part of space that is shown: stations and truth always, estimates as far as the picture can bear.
import { niceStep } from '../../../chart/scale';
import type { Box, Point } from './projection';
import type { Track } from './tracks';

/** How far beyond stations and truth an estimate may push the edge, as a share of their extent. */
const reach = 0.6;

type Edges = { min: [number, number, number]; max: [number, number, number] };

function nothing(): Edges {
  return { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
}

function take(edges: Edges, axis: 0 | 1 | 2, value: number): void {
  if (!Number.isFinite(value)) return;
  if (value < edges.min[axis]) edges.min[axis] = value;
  if (value > edges.max[axis]) edges.max[axis] = value;
}

function takeTrack(edges: Edges, track: Track, limit: Box | null): void {
  const axes = [track.x, track.y, track.z] as const;
  axes.forEach((values, a) => {
    const axis = a as 0 | 1 | 2;
    for (let i = 0; i < track.length; i++) {
      const value = values[i]!;
      take(edges, axis, limit ? Math.min(limit.max[axis], Math.max(limit.min[axis], value)) : value);
    }
  });
}

/** Edges on round numbers, so that the ground's grid ends where the ground does. The same while what is shown fits and is not far too small for it. */
export function spaceBox(places: readonly (Point | null)[], truth: Track, estimates: readonly Track[], before: Box | null): Box | null {
  const edges = nothing();
  for (const place of places) place?.forEach((value, axis) => take(edges, axis as 0 | 1 | 2, value));
  takeTrack(edges, truth, null);
  if (!(edges.max[0] >= edges.min[0])) return before;
  const extent = Math.max(...([0, 1, 2] as const).map((axis) => edges.max[axis] - edges.min[axis]), 1e-6);
  const margin = reach * extent;
  const limit: Box = { min: [edges.min[0] - margin, edges.min[1] - margin, edges.min[2] - margin], max: [edges.max[0] + margin, edges.max[1] + margin, edges.max[2] + margin] };
  for (const estimate of estimates) takeTrack(edges, estimate, limit);
  if (edges.min[2] > 0 && edges.min[2] < extent) edges.min[2] = 0;
  const box = rounded(edges, extent);
  return before && holds(before, edges) && !wasteful(before, box) ? before : box;
}

function rounded({ min, max }: Edges, extent: number): Box {
  const step = niceStep(extent / 10);
  const low = (value: number): number => Math.floor(value / step + 1e-6) * step;
  const high = (value: number): number => Math.ceil(value / step - 1e-6) * step;
  return { min: [low(min[0]), low(min[1]), min[2] === 0 ? 0 : low(min[2])], max: [high(max[0]), high(max[1]), high(max[2])] };
}

function holds(box: Box, { min, max }: Edges): boolean {
  return ([0, 1, 2] as const).every((axis) => min[axis] >= box.min[axis] && max[axis] <= box.max[axis]);
}

function wasteful(box: Box, enough: Box): boolean {
  return ([0, 1, 2] as const).some((axis) => box.max[axis] - box.min[axis] > 1.5 * (enough.max[axis] - enough.min[axis]));
}

/** Height of the ground: 0 where the box has it, else its lowest level. */
export function groundOf(box: Box): number {
  return box.min[2] <= 0 && box.max[2] >= 0 ? 0 : box.min[2];
}
