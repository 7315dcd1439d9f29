/// The record of a design, as the run holds it: gains, their certificate, and how they were found. Nothing is computed here.
import type { RunDetail } from '../../../api/types';

export interface DesignRecord {
  key: string | null;
  holds: boolean | null;
  reason: string;
  solver: string;
  verdict: string;
  detail: string;
  iterations: number | null;
  seconds: number | null;
  objective: number | null;
  gammaD: number[];
  gammaW: number[];
  kappa: number[];
  lambdaMaxSigma: number | null;
  lambdaMinP: number | null;
  maxRealPole: number | null;
  fastestPole: number | null;
  normL: number[];
  margins: { block: string; value: number | null }[];
  poles: { re: number; im: number }[];
  matched: boolean[];
  gains: number[][][];
}

/** A lane's record; null where the run has none. What is missing in it is empty or null. */
export function recordOf(run: Pick<RunDetail, 'design'> | null, lane: string): DesignRecord | null {
  const raw = run?.design?.[lane];
  return raw && typeof raw === 'object' && ('holds' in raw || 'poles' in raw || 'matched' in raw) ? readRecord(raw) : null;
}

export function readRecord(raw: Record<string, unknown>): DesignRecord {
  const number = (name: string): number | null => finite(raw[name]);
  const text = (name: string): string => (typeof raw[name] === 'string' ? raw[name] : '');
  return {
    key: text('key') || null,
    holds: typeof raw.holds === 'boolean' ? raw.holds : null,
    reason: text('reason'),
    solver: text('solver'),
    verdict: text('verdict'),
    detail: text('detail'),
    iterations: number('iterations'),
    seconds: number('seconds'),
    objective: number('objective'),
    gammaD: numbers(raw.gamma_d),
    gammaW: numbers(raw.gamma_w),
    kappa: numbers(raw.kappa),
    lambdaMaxSigma: number('lambda_max_sigma'),
    lambdaMinP: number('lambda_min_p'),
    maxRealPole: number('max_real_pole'),
    fastestPole: number('fastest_pole'),
    normL: numbers(raw.norm_l),
    margins: list(raw.margins).flatMap((one) => (isObject(one) && typeof one.block === 'string' ? [{ block: one.block, value: finite(one.value) }] : [])),
    poles: list(raw.poles).flatMap((one) => (Array.isArray(one) && finite(one[0]) !== null ? [{ re: one[0] as number, im: finite(one[1]) ?? 0 }] : [])),
    matched: list(raw.matched).filter((one) => typeof one === 'boolean'),
    gains: list(raw.L).flatMap((one) => (Array.isArray(one) ? [one.map(numbers)] : [])),
  };
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null;
}

function finite(value: unknown): number | null {
  return typeof value === 'number' && Number.isFinite(value) ? value : null;
}

function list(value: unknown): unknown[] {
  return Array.isArray(value) ? value : [];
}

/** A number that a subsystem does not have (it has no disturbance, say) stays in its place as NaN. */
function numbers(value: unknown): number[] {
  return list(value).map((one) => finite(one) ?? NaN);
}

/** What a lane of the document is set to. */
export interface LaneDocument {
  method: string;
  params: Readonly<Record<string, unknown>>;
}

export function laneDocument(run: Pick<RunDetail, 'document'> | null, lane: string): LaneDocument | null {
  const own = (run?.document?.lanes as Record<string, { method?: unknown; params?: Record<string, unknown> } | undefined> | undefined)?.[lane];
  return own ? { method: String(own.method ?? ''), params: own.params ?? {} } : null;
}
