import type { Series } from '../../data/series';

/** A line of a chart: which signal, how it is drawn, how it is called. */
export interface LineSpec {
  key: string;
  name: string;
  signal: string;
  /** Colour token. */
  token: string;
  width: number;
  dash: number[];
  /** Drawn from the signal's values, e.g. their squares. */
  map?: (series: Series) => Series;
  strong?: boolean;
}

/** Every value squared: comparable with a trace of a covariance. */
export function squared(series: Series): Series {
  const lo = series.lo.map((v) => v * v);
  return { ...series, lo, hi: series.lo === series.hi ? lo : series.hi.map((v) => v * v) };
}
