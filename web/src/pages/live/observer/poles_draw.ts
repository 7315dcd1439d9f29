/// Poles in the plane: what lies right of the imaginary axis is unstable, and looks so.
import { axisFont } from '../../../chart/axes';
import { colour } from '../../../chart/colours';
import { fit, fraction, scaleTicks, tickLabel, type Scale } from '../../../chart/scale';

export interface Pole {
  re: number;
  im: number;
}

/** Real and imaginary parts within this are drawn linearly where larger ones are logarithmic. */
export const linearWithin = 1;

const room = { left: 46, right: 10, top: 6, bottom: 18 };

export function poleScales(poles: readonly Pole[], log: boolean): { re: Scale; im: Scale } {
  const middle = log ? linearWithin : 0;
  const re = { lo: Math.min(0, ...poles.map((pole) => pole.re)), hi: Math.max(0, ...poles.map((pole) => pole.re)) };
  const size = Math.max(1e-3, ...poles.map((pole) => Math.abs(pole.im)));
  return { re: fit(re, false, middle), im: fit({ lo: -size, hi: size }, false, middle) };
}

export function drawPoles(context: CanvasRenderingContext2D, width: number, height: number, poles: readonly Pole[], log: boolean, token: string): void {
  const { re, im } = poleScales(poles, log);
  const [right, bottom] = [width - room.right, height - room.bottom];
  const x = (value: number): number => room.left + fraction(re, value) * (right - room.left);
  const y = (value: number): number => bottom - fraction(im, value) * (bottom - room.top);
  context.fillStyle = colour('grid');
  context.fillRect(x(0), room.top, Math.max(0, right - x(0)), bottom - room.top);
  context.font = axisFont;
  context.lineWidth = 1;
  drawGrid(context, scaleTicks(re, (right - room.left) / 62), (value) => ({ at: x(value), zero: value === 0 }), (at) => [at, room.top, at, bottom], (text, at) => {
    context.textAlign = 'center';
    context.textBaseline = 'alphabetic';
    context.fillText(text, Math.min(at, width - 14), height - 4);
  });
  drawGrid(context, scaleTicks(im, (bottom - room.top) / 26), (value) => ({ at: y(value), zero: value === 0 }), (at) => [room.left, at, right, at], (text, at) => {
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    context.fillText(text, room.left - 5, at);
  });
  for (const pole of poles) cross(context, x(pole.re), y(pole.im), pole.re < 0 ? token : 'bad');
}

function drawGrid(
  context: CanvasRenderingContext2D,
  values: readonly number[],
  place: (value: number) => { at: number; zero: boolean },
  line: (at: number) => [number, number, number, number],
  label: (text: string, at: number) => void,
): void {
  for (const value of values) {
    const { at, zero } = place(value);
    const [x0, y0, x1, y1] = line(Math.round(at) + 0.5);
    context.strokeStyle = colour(zero ? 'control' : 'grid');
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
    context.fillStyle = colour('muted');
    label(tickLabel(value), at);
  }
}

function cross(context: CanvasRenderingContext2D, x: number, y: number, token: string): void {
  context.strokeStyle = colour(token);
  context.lineWidth = 1.7;
  context.beginPath();
  for (const side of [1, -1]) {
    context.moveTo(x - 4, y - 4 * side);
    context.lineTo(x + 4, y + 4 * side);
  }
  context.stroke();
}
