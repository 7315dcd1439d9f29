/// The constants that a protection computed before the run, as the API gives them. What is missing or malformed counts as not given.
import type { RunDetail } from '../../../api/types';

/** How far apart two neighbouring trajectories look to one observer. */
export interface View {
  name: string;
  node: string;
  /** Infinity: the observer sees the difference itself. */
  mu: number;
  /** Exact probability that the privacy loss exceeds epsilon. */
  pLoss: number | null;
  /** Least epsilon for the design's delta, exact. */
  epsAtDelta: number | null;
}

export interface Release {
  node: string;
  component: string;
  /** Standard deviation of what is added. */
  std: number;
  /** Distance of the means of two neighbouring releases. */
  shift: number;
}

export interface KappaCurve {
  values: number[];
  pdfe: number[];
  cdfe: number[];
}

export interface Plane {
  epsilon: number[];
  delta: number[];
  /** One row an epsilon, one column a delta. */
  pdfe: number[][];
  cdfe: number[][];
}

export interface PrivacyDesign {
  gamma: number | null;
  epsilon: number | null;
  delta: number | null;
  leak: number | null;
  slope: number | null;
  dpOk: boolean | null;
  nullDim: number | null;
  /** 1 / gamma: the mu that the mechanism is designed for. */
  designMu: number | null;
  traceLegitimate: number | null;
  traceOptimal: number | null;
  traceEavesdropper: ReadonlyMap<string, number>;
  views: View[];
  releases: Release[];
  kappa: KappaCurve | null;
  plane: Plane | null;
}

type Raw = Record<string, unknown>;

const isObject = (value: unknown): value is Raw => typeof value === 'object' && value !== null && !Array.isArray(value);
const finite = (value: unknown): number | null => (typeof value === 'number' && Number.isFinite(value) ? value : null);
const numbers = (value: unknown): number[] => (Array.isArray(value) ? value.map((one) => finite(one) ?? NaN) : []);

export function designOf(run: Pick<RunDetail, 'design'> | null, lane: string): PrivacyDesign | null {
  const raw = run?.design?.[lane];
  if (!isObject(raw)) return null;
  const gamma = finite(raw.gamma);
  const surfaces = isObject(raw.surfaces) ? raw.surfaces : {};
  return {
    gamma,
    epsilon: finite(raw.epsilon),
    delta: finite(raw.delta),
    leak: finite(raw.leak),
    slope: finite(raw.slope),
    dpOk: typeof raw.dp_ok === 'boolean' ? raw.dp_ok : null,
    nullDim: finite(raw.null_dim),
    designMu: finite(raw.views_design_mu) ?? (gamma ? 1 / gamma : null),
    traceLegitimate: finite(raw.trace_legitimate),
    traceOptimal: finite(raw.trace_optimal),
    traceEavesdropper: tracesOf(raw.trace_eavesdropper),
    views: viewsOf(raw.views),
    releases: releasesOf(raw.releases),
    kappa: kappaOf(surfaces.kappa),
    plane: planeOf(surfaces.epsilon_delta),
  };
}

function tracesOf(raw: unknown): Map<string, number> {
  const entries = isObject(raw) ? Object.entries(raw) : [];
  return new Map(entries.flatMap(([variant, value]): [string, number][] => (finite(value) === null ? [] : [[variant, value as number]])));
}

function viewsOf(raw: unknown): View[] {
  if (!isObject(raw)) return [];
  return Object.entries(raw).flatMap(([name, nodes]) =>
    Object.entries(isObject(nodes) ? nodes : {}).flatMap(([node, one]): View[] => {
      if (!isObject(one)) return [];
      const mu = one.infinite === true ? Infinity : finite(one.mu);
      return mu === null ? [] : [{ name, node, mu, pLoss: finite(one.p_loss), epsAtDelta: finite(one.eps_at_delta) }];
    }),
  );
}

function releasesOf(raw: unknown): Release[] {
  return (Array.isArray(raw) ? raw : []).flatMap((one): Release[] => {
    const [std, shift] = isObject(one) ? [finite(one.std), finite(one.shift)] : [null, null];
    return std === null || shift === null || std <= 0 ? [] : [{ node: String((one as Raw).node ?? ''), component: String((one as Raw).component ?? ''), std, shift }];
  });
}

function kappaOf(raw: unknown): KappaCurve | null {
  if (!isObject(raw)) return null;
  const curve = { values: numbers(raw.values), pdfe: numbers(raw.pdfe), cdfe: numbers(raw.cdfe) };
  return curve.values.length > 1 && curve.pdfe.length === curve.values.length && curve.cdfe.length === curve.values.length ? curve : null;
}

function planeOf(raw: unknown): Plane | null {
  if (!isObject(raw)) return null;
  const rows = (value: unknown): number[][] => (Array.isArray(value) ? value.map(numbers) : []);
  const plane = { epsilon: numbers(raw.epsilon), delta: numbers(raw.delta), pdfe: rows(raw.pdfe), cdfe: rows(raw.cdfe) };
  const fits = (matrix: number[][]): boolean => matrix.length === plane.epsilon.length && matrix.every((row) => row.length === plane.delta.length);
  return plane.epsilon.length && plane.delta.length && fits(plane.pdfe) && fits(plane.cdfe) ? plane : null;
}
