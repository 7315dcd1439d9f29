/// From space to the screen: parallel projection, so that equal lengths along an axis stay equal and can be read off.
export type Point = readonly [x: number, y: number, z: number];
export type Sight = 'space' | 'xy' | 'xz' | 'yz';

/** Whence the space is seen, in degrees: the azimuth of the eye about z, from the x axis, and its height above the ground. */
export interface Turn {
  azimuth: number;
  height: number;
}

export const usualTurn: Turn = { azimuth: -60, height: 34 };
const lowest = 4;
const highest = 90;

/** Right and up on the screen, and the direction to the eye: orthonormal, right-handed. */
export interface Basis {
  right: Point;
  up: Point;
  eye: Point;
}

const planes: Record<Exclude<Sight, 'space'>, Basis> = {
  xy: { right: [1, 0, 0], up: [0, 1, 0], eye: [0, 0, 1] },
  xz: { right: [1, 0, 0], up: [0, 0, 1], eye: [0, -1, 0] },
  yz: { right: [0, 1, 0], up: [0, 0, 1], eye: [1, 0, 0] },
};

export function basisOf(sight: Sight, turn: Turn): Basis {
  if (sight !== 'space') return planes[sight];
  const a = (turn.azimuth * Math.PI) / 180;
  const h = (turn.height * Math.PI) / 180;
  const [ca, sa, ch, sh] = [Math.cos(a), Math.sin(a), Math.cos(h), Math.sin(h)];
  return { right: [-sa, ca, 0], up: [-sh * ca, -sh * sa, ch], eye: [ch * ca, ch * sa, sh] };
}

/** The turn after the hand moved by some pixels: half a degree each, the scene follows the hand. */
export function dragged(turn: Turn, dx: number, dy: number): Turn {
  return turned(turn, -dx / 2, dy / 2);
}

/** The turn changed by some degrees; the eye never goes below the ground. */
export function turned(turn: Turn, azimuth: number, height: number): Turn {
  const about = turn.azimuth + azimuth;
  return { azimuth: about - 360 * Math.round(about / 360), height: Math.min(highest, Math.max(lowest, turn.height + height)) };
}

/** "-60,26", as the address has it; null where it is not one. */
export function parseTurn(text: string | null): Turn | null {
  const found = /^(-?\d{1,3}(?:\.\d)?),(\d{1,2}(?:\.\d)?)$/.exec(text ?? '');
  return found ? turned({ azimuth: Number(found[1]), height: Number(found[2]) }, 0, 0) : null;
}

export function turnText(turn: Turn): string | null {
  const round = (value: number): number => Math.round(value * 10) / 10;
  const text = `${round(turn.azimuth)},${round(turn.height)}`;
  return text === `${usualTurn.azimuth},${usualTurn.height}` ? null : text;
}

export interface Box {
  min: Point;
  max: Point;
}

/** Room in CSS pixels about the drawing. */
export interface Margins {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** A projection onto a canvas: screen = offset + scale * (basis . point), y downwards. */
export class Projection {
  readonly scale: number;
  private readonly x0: number;
  private readonly y0: number;

  constructor(
    readonly basis: Basis,
    box: Box,
    readonly width: number,
    readonly height: number,
    readonly margins: Margins,
    turning: boolean,
  ) {
    const size = turning ? turningSize(box, basis) : flatSize(box, basis);
    const room = { width: width - margins.left - margins.right, height: height - margins.top - margins.bottom };
    this.scale = Math.max(1e-9, Math.min(room.width / (size.width || 1e-9), room.height / (size.height || 1e-9)));
    const [cx, cy, cz] = centre(box);
    this.x0 = margins.left + room.width / 2 - this.scale * dot(basis.right, cx, cy, cz);
    this.y0 = margins.top + room.height / 2 + this.scale * dot(basis.up, cx, cy, cz);
  }

  x(px: number, py: number, pz: number): number {
    return this.x0 + this.scale * dot(this.basis.right, px, py, pz);
  }

  y(px: number, py: number, pz: number): number {
    return this.y0 - this.scale * dot(this.basis.up, px, py, pz);
  }

  /** Where a coordinate along `right` or `up` is on the canvas, and back. */
  atRight(value: number): number {
    return this.x0 + this.scale * value;
  }
  atUp(value: number): number {
    return this.y0 - this.scale * value;
  }
  right(x: number): number {
    return (x - this.x0) / this.scale;
  }
  up(y: number): number {
    return (this.y0 - y) / this.scale;
  }
}

export function dot(a: Point, x: number, y: number, z: number): number {
  return a[0] * x + a[1] * y + a[2] * z;
}

function centre({ min, max }: Box): Point {
  return [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
}

/** What the box takes on the screen seen straight along an axis. */
function flatSize({ min, max }: Box, { right, up }: Basis): { width: number; height: number } {
  const extent: Point = [max[0] - min[0], max[1] - min[1], max[2] - min[2]];
  return { width: Math.abs(dot(right, ...extent)), height: Math.abs(dot(up, ...extent)) };
}

/** What it takes at the worst azimuth: turning it neither grows nor shrinks the scene. */
function turningSize({ min, max }: Box, { up }: Basis): { width: number; height: number } {
  const across = Math.hypot(max[0] - min[0], max[1] - min[1]);
  return { width: across, height: across * Math.sqrt(Math.max(0, 1 - up[2] * up[2])) + (max[2] - min[2]) * up[2] };
}
