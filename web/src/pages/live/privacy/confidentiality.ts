/// The confidentiality index of every lane: what it is now, what it is called, and what the paper says (specification, 1.7 and 4.7).
import type { RunDetail } from '../../../api/types';
import { valueAt } from '../../../data/series';
import type { Source } from '../../../data/source';
import type { LaneModel, RunModel } from '../model';
import { known, protectionOf, squareOf, variantsOf } from './centre';

/** Bounds of the ranks, (4-34). */
export const rankBounds = [1, 2, 4, 8] as const;
export const rankWords = ['rank_low', 'rank_rather_low', 'rank_medium', 'rank_rather_high', 'rank_high'] as const;

/** (4-34); what is negative is low. */
export function rankOf(index: number): number {
  return rankBounds.filter((bound) => index >= bound).length;
}

/** What an index compares: traces of covariances, or squared errors of this run pooled since tick 1. */
export type Measure = 'covariance' | 'errors';

export interface Reading {
  value: number;
  measure: Measure;
}

export interface LaneReading {
  lane: LaneModel;
  /** Against whom the mechanism is meant; null: nothing yet. */
  main: Reading | null;
  /** As the run says; null: it does not. */
  rank: number | null;
  others: { variant: string; reading: Reading }[];
  /** The variant that `main` is about. */
  variant: string;
}

/** From covariances where there are any, else from errors. */
function reading(at: (name: string) => number, head: string): Reading | null {
  const exact = at(`${head}ci`);
  if (!Number.isNaN(exact)) return { value: exact, measure: 'covariance' };
  const pooled = at(`${head}ci_mse`);
  return Number.isNaN(pooled) ? null : { value: pooled, measure: 'errors' };
}

/** Every lane's indices at a tick. */
export function readingsAt(model: RunModel, source: Pick<Source, 'near'>, k: number): LaneReading[] {
  const at = (name: string): number => (known(model, name) ? valueAt(source.near(name, k - 1, k), k, 1) : NaN);
  return model.lanes
    .filter((lane) => squareOf(model, lane) !== null)
    .map((lane) => {
      const variants = variantsOf(model, lane);
      const rank = at(`lane.${lane.id}.rank`);
      return {
        lane,
        main: reading(at, `lane.${lane.id}.`),
        rank: Number.isNaN(rank) ? null : rank,
        others: variants.slice(1).flatMap((variant) => {
          const own = reading(at, `lane.${lane.id}.eve.${variant}.`);
          return own ? [{ variant, reading: own }] : [];
        }),
        variant: variants[0] ?? 'fusing',
      };
    });
}

/** What chapter 4 of seed 004 prints of a mechanism on its plant: a number, or that the index is infinite. */
export type PaperIndex = number | 'infinite';

const printed: Readonly<Record<string, PaperIndex>> = { contamination: 1.23, two_step: 'infinite' };
/** The example that the numbers are printed for. */
const engine = 'privacy-engine';
const printedCodeA: PaperIndex = 3.66;

interface Code {
  code: unknown;
  loss: unknown;
}

function codeOf(run: Pick<RunDetail, 'document'> | null, lane: string): Code {
  const own = (run?.document?.lanes as Record<string, { protection?: { params?: Partial<Code> } } | undefined> | undefined)?.[lane];
  return { code: own?.protection?.params?.code ?? 'A', loss: own?.protection?.params?.loss ?? fittedLoss };
}

/** The share of missed messages with which code A has the index that the paper prints: the paper does not say it. */
const fittedLoss = 0.36;

/** Whether an index agrees with the paper's because a number was fitted to it. */
export function isFitted(run: Pick<RunDetail, 'document'> | null, lane: string): boolean {
  const { code, loss } = codeOf(run, lane);
  return protectionOf(run, lane) === 'secrecy_code' && code === 'A' && loss === fittedLoss;
}

export function paperIndex(run: Pick<RunDetail, 'document' | 'scenario'> | null, lane: string): PaperIndex | null {
  if (run?.scenario !== engine) return null;
  const type = protectionOf(run, lane);
  if (type !== 'secrecy_code') return printed[type] ?? null;
  return codeOf(run, lane).code === 'A' ? printedCodeA : null;
}

export interface GaugeScale {
  lo: number;
  hi: number;
}

/** The scale that every gauge shares: every rank is equally wide, and holds every value, negative ones too. */
export function gaugeScale(readings: readonly LaneReading[]): GaugeScale {
  const values = readings.flatMap(({ main, others }) => [main, ...others.map((one) => one.reading)]).flatMap((one) => (one && Number.isFinite(one.value) ? [one.value] : []));
  return { lo: Math.min(-1, Math.floor(Math.min(...values, 0) - 0.2)), hi: Math.max(16, Math.ceil(Math.max(...values, 0) + 0.5)) };
}

/** Edges of the ranks on a scale, first and last its ends. */
export function rankEdges({ lo, hi }: GaugeScale): number[] {
  return [lo, ...rankBounds, hi];
}

/** Where an index is on its scale, 0 to 1. */
export function gaugePlace(scale: GaugeScale, index: number): number {
  const edges = rankEdges(scale);
  const value = Math.min(scale.hi, Math.max(scale.lo, index));
  const rank = rankOf(value);
  const [from, to] = [edges[rank]!, edges[rank + 1]!];
  return (rank + (value - from) / (to - from)) / (edges.length - 1);
}
