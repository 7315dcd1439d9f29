/// The ways as numbers: read from the samples when they change, kept while the view only turns.
import { valueAt, type Series } from '../../../data/series';
import type { Names } from './space_model';
import type { Point } from './projection';

export interface Track {
  k: Float64Array;
  joined: Uint8Array;
  x: Float64Array;
  y: Float64Array;
  z: Float64Array;
  length: number;
}

/** The part of a way from tick `from` to `to`. Its three signals come from one stream or one answer: they share their ticks. */
export function readTrack(read: (signal: string) => Series, names: Names, from: number, to: number): Track {
  const [x, y, z] = [read(names[0]), read(names[1]), read(names[2])];
  const most = Math.min(x.k.length, y.k.length, z.k.length);
  let begin = 0;
  while (begin < most && x.k[begin]! < from) begin++;
  let end = most;
  while (end > begin && x.k[end - 1]! > to) end--;
  const part = <T extends Float64Array | Uint8Array>(values: T): T => values.subarray(begin, end) as T;
  return { k: part(x.k), joined: part(x.joined), x: part(x.hi), y: part(y.hi), z: part(z.hi), length: end - begin };
}

/** Ways of a wider window than this come reduced to extremes, which make no way: then only the newest part is drawn. */
export const widest = 1000;
export const tail = 50;

/** Where a way stands at its end, if that is no older than a few ticks; null while it is empty there. */
export function endOf(track: Track, at: number): Point | null {
  const i = track.length - 1;
  if (i < 0 || at - track.k[i]! > 3) return null;
  const [x, y, z] = [track.x[i]!, track.y[i]!, track.z[i]!];
  return Number.isFinite(x + y + z) ? [x, y, z] : null;
}

/** Whether a track reaches from `from` to `to`: if not, more of it may be on its way. */
export function reaches(track: Track, from: number, to: number): boolean {
  return track.length > 0 && track.k[0]! <= Math.max(0, from) && track.k[track.length - 1]! >= to;
}

/** The state of a station's sensor at a tick; 0 where nothing is known. */
export function stateAt(read: (signal: string) => Series, signal: string | null, at: number): number {
  const value = signal ? valueAt(read(signal), at, 1) : 0;
  return Number.isFinite(value) ? value : 0;
}
