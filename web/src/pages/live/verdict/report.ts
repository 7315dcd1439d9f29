/// The identifiability report of a lane with a window (seed 001, Proposition 2, Theorem 1, Corollary 1).
import type { RunDetail } from '../../../api/types';
import { laneOf, type LaneModel, type RunModel } from '../model';

export interface StationReport {
  node: string;
  eigvecSupport: number;
  phiSupport: number;
  coherence: number;
}

export interface Report {
  /** s after the start: where on the target's way it was made. */
  time: number;
  /** Attacked channels a node that the lane is to stand. */
  q: number;
  /** Largest q that the eigenvector test allows. */
  qMax: number;
  dimensionOk: boolean;
  /** 2 q T, and p T - n. */
  dimension: [number, number];
  /** Least over stations and eigenvectors. */
  eigvecSupport: number;
  phiSupport: number;
  /** Largest over stations. */
  coherence: number;
  stations: StationReport[];
}

type Fields = Record<string, unknown>;
const isFields = (value: unknown): value is Fields => typeof value === 'object' && value !== null && !Array.isArray(value);
const isNumber = (value: unknown): value is number => typeof value === 'number' && Number.isFinite(value);

/** Null where it is not such a report. */
export function readReport(value: unknown): Report | null {
  if (!isFields(value)) return null;
  const { time, q, q_max: qMax, dimension_ok: dimensionOk, dimension, eigvec_support: eigvecSupport, phi_support: phiSupport, coherence, stations } = value;
  if (!Array.isArray(dimension) || !isNumber(dimension[0]) || !isNumber(dimension[1]) || typeof dimensionOk !== 'boolean') return null;
  if (!isNumber(time) || !isNumber(q) || !isNumber(qMax) || !isNumber(eigvecSupport) || !isNumber(phiSupport) || !isNumber(coherence)) return null;
  return { time, q, qMax, dimensionOk, dimension: [dimension[0], dimension[1]], eigvecSupport, phiSupport, coherence, stations: Array.isArray(stations) ? stations.flatMap(readStation) : [] };
}

function readStation(value: unknown): StationReport[] {
  if (!isFields(value)) return [];
  const { node, eigvec_support: eigvecSupport, phi_support: phiSupport, coherence } = value;
  if (!isNumber(eigvecSupport) || !isNumber(phiSupport) || !isNumber(coherence)) return [];
  return [{ node: String(node), eigvecSupport, phiSupport, coherence }];
}

/** The chosen lane's report; where it has none, that of the first lane that has one. */
export function reportOf(run: Pick<RunDetail, 'design'>, model: RunModel, lane: string | null): { lane: LaneModel; report: Report } | null {
  const chosen = laneOf(model, lane);
  for (const one of [...(chosen ? [chosen] : []), ...model.lanes]) {
    const report = readReport(run.design?.[one.id]?.identifiability);
    if (report) return { lane: one, report };
  }
  return null;
}

/** Entries fewer than this are surely found by matching pursuit at this coherence (Tropp 2004): (1 + 1/mu) / 2. */
export function coherenceLimit(coherence: number): number {
  return coherence > 0 ? (1 + 1 / coherence) / 2 : Infinity;
}

/** The most entries that the coherence guarantees: fewer than the limit. */
export function coveredEntries(coherence: number): number {
  const limit = coherenceLimit(coherence);
  return Number.isFinite(limit) ? Math.max(0, Math.ceil(limit - 1e-12) - 1) : Infinity;
}

/** Whether the loop's poles are complex: null where the document does not tell. */
export function complexPoles(document: unknown): boolean | null {
  const params = isFields(document) && isFields(document.plant) && isFields(document.plant.params) ? document.plant.params : {};
  const pairs = Object.entries(params).filter(([name, value]) => name.startsWith('poles_') && Array.isArray(value) && isNumber(value[1]));
  return pairs.length ? pairs.some(([, value]) => (value as number[])[1] !== 0) : null;
}
