/// Frames of drawings: two scales, their grid and labels.
import { colour } from '../../chart/colours';
import { fraction, scaleTicks, tickLabel, type Scale } from '../../chart/scale';
import type { Mark } from './scene';

export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** Room around a plot for its labels. */
export function boxOf(width: number, height: number, room: { left?: number; right?: number; top?: number; bottom?: number } = {}): Box {
  return { left: room.left ?? 52, right: width - (room.right ?? 10), top: room.top ?? 8, bottom: height - (room.bottom ?? 34) };
}

export const place = {
  x: (box: Box, scale: Scale, value: number): number => box.left + fraction(scale, value) * (box.right - box.left),
  y: (box: Box, scale: Scale, value: number): number => box.bottom - fraction(scale, value) * (box.bottom - box.top),
};

export function yAxis(box: Box, scale: Scale): Mark[] {
  return scaleTicks(scale, (box.bottom - box.top) / 32).flatMap((value): Mark[] => {
    const y = Math.round(place.y(box, scale, value)) + 0.5;
    return [
      { type: 'line', points: [box.left, y, box.right, y], colour: colour(value === 0 && scale.lo < 0 ? 'control' : 'grid') },
      { type: 'text', x: box.left - 6, y, text: tickLabel(value), fill: colour('muted'), align: 'end' },
    ];
  });
}

export function xAxis(box: Box, scale: Scale): Mark[] {
  return scaleTicks(scale, (box.right - box.left) / 90).flatMap((value) => xTick(box, place.x(box, scale, value), tickLabel(value), value === 0 && scale.lo < 0));
}

export function xTick(box: Box, at: number, text: string, zero = false): Mark[] {
  const x = Math.round(at) + 0.5;
  return [
    { type: 'line', points: [x, box.top, x, box.bottom], colour: colour(zero ? 'control' : 'grid') },
    { type: 'text', x, y: box.bottom + 10, text, fill: colour('muted'), align: 'middle' },
  ];
}

/** What the horizontal axis is. */
export function xTitle(box: Box, text: string): Mark {
  return { type: 'text', x: (box.left + box.right) / 2, y: box.bottom + 25, text, fill: colour('muted'), align: 'middle' };
}

export function yTitle(box: Box, text: string): Mark {
  return { type: 'text', x: 8, y: (box.top + box.bottom) / 2, text, fill: colour('muted'), align: 'middle', turned: true };
}

/** Least and greatest of what are numbers; positive ones only where asked. Null: none. */
export function rangeOf(values: Iterable<number | null | undefined>, positive = false): { lo: number; hi: number } | null {
  let lo = Infinity;
  let hi = -Infinity;
  for (const value of values) {
    if (value === null || value === undefined || !Number.isFinite(value) || (positive && value <= 0)) continue;
    if (value < lo) lo = value;
    if (value > hi) hi = value;
  }
  return lo <= hi ? { lo, hi } : null;
}

/** A text in so many px of the axes' font. */
export function cut(text: string, width: number): string {
  const most = Math.max(2, Math.floor(width / 6.4));
  return text.length <= most ? text : `${text.slice(0, most - 1)}…`;
}
