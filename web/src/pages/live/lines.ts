import { closeDifference, difference, type Series } from '../../data/series';
import type { Source } from '../../data/source';

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
  /** A signal that is taken away, tick by tick. */
  minus?: string;
  /** The two move together, so far between two points of a wide window that only every tick tells their difference. */
  close?: boolean;
  /** No stream of this page carries it. */
  unstreamed?: boolean;
  strong?: boolean;
}

/** What of a line says which values it draws. */
export type ReadLine = Pick<LineSpec, 'signal' | 'minus' | 'map' | 'close' | 'unstreamed'>;

/** Every value squared: comparable with a trace of a covariance. */
export function squared(series: Series): Series {
  const lo = series.lo.map((v) => v * v);
  return { ...series, lo, hi: series.lo === series.hi ? lo : series.hi.map((v) => v * v) };
}

/** The values that a line draws. */
export function readLine(line: ReadLine, read: (signal: string) => Series): Series {
  const own = read(line.signal);
  const series = line.minus ? (line.close ? closeDifference : difference)(own, read(line.minus)) : own;
  return line.map ? line.map(series) : series;
}

/** The values of a line in a window, from wherever they are. */
export function lineOf(line: ReadLine, source: Source, from: number, to: number): Series {
  const read = (name: string): Series => (!line.close ? source.get(name, from, to) : line.unstreamed ? source.logged(name, from, to) : source.exact(name, from, to));
  return readLine(line, read);
}
