/// Plane sections of what a filter says of its own error: the ellipsoid of the bounded part, the covariance of the random part.

/** A symmetric 2 x 2 matrix [[xx, xy], [xy, yy]]. */
export interface Shape {
  xx: number;
  xy: number;
  yy: number;
}

export interface Axes {
  /** Half axes, the longer first. */
  a: number;
  b: number;
  /** Angle of the longer one, rad, against the first component. */
  angle: number;
}

/**
 * The ellipse {d : d' shape^-1 d <= times^2}; null where the matrix is missing or not positive semidefinite. An axis may be
 * zero. The projection of a larger ellipsoid on a plane has the block of its shape matrix that belongs to the plane.
 */
export function axesOf({ xx, xy, yy }: Shape, times = 1): Axes | null {
  if (![xx, xy, yy].every(Number.isFinite)) return null;
  const middle = (xx + yy) / 2;
  const half = Math.hypot((xx - yy) / 2, xy);
  const [large, small] = [middle + half, middle - half];
  const slack = 1e-12 * Math.max(1, Math.abs(large));
  if (large < -slack || small < -slack) return null;
  return { a: times * Math.sqrt(Math.max(0, large)), b: times * Math.sqrt(Math.max(0, small)), angle: half === 0 ? 0 : Math.atan2(2 * xy, xx - yy) / 2 };
}

/** Half the width of the ellipse along one component: how far the true one may be from the estimate. */
export function reach(variance: number, times = 1): number {
  return variance >= 0 ? times * Math.sqrt(variance) : NaN;
}
