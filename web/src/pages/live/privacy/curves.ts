/// How the curves of this family look, and the lines that charts draw of them.
import { laneDash } from '../../../chart/colours';
import type { Series } from '../../../data/series';
import type { LineSpec } from '../lines';
import { laneWord, type LaneModel, type RunModel } from '../model';
import { curvesOf, isShown, type Curve } from './centre';
import { t } from './words';

/** Above this nothing is drawn; the log has the number. */
export const mostDrawn = 1e150;

/** A diverging error stays on the picture, however far it goes. */
export function clipped(series: Series): Series {
  const cut = (values: Float64Array): Float64Array => (values.some((v) => v > mostDrawn) ? values.map((v) => (v > mostDrawn ? mostDrawn : v)) : values);
  const lo = cut(series.lo);
  return { ...series, lo, hi: series.lo === series.hi ? lo : cut(series.hi) };
}

const variantDashes: Readonly<Record<string, number[]>> = { fusing: [], differencing: [9, 3], window_mean: [2, 3], zero: [10, 3, 2, 3] };

export interface Look {
  token: string;
  dash: number[];
  width: number;
}

/** The user has the lane's own colour, every eavesdropper the one of overhearing; nodes differ by their dashes. */
export function lookOf(curve: Pick<Curve, 'role' | 'node' | 'variant'>, lane: Pick<LaneModel, 'token'>, nodes: readonly string[]): Look {
  const dash = curve.node === null ? [] : laneDash(nodes.indexOf(curve.node));
  switch (curve.role) {
    case 'fused':
      return { token: lane.token, dash: [], width: 2.2 };
    case 'optimal':
      return { token: 'ink', dash: [1.5, 3], width: 1.5 };
    case 'eve':
      return { token: 'overheard', dash: variantDashes[curve.variant ?? ''] ?? [5, 3], width: 1.8 };
    case 'compensated':
      return { token: 'lane-7', dash, width: 1.5 };
    case 'sent':
      return { token: 'fdi', dash, width: 1.5 };
    case 'local':
      return { token: 'muted', dash, width: 1.5 };
  }
}

const roleWords = { fused: 'role_fused', optimal: 'role_optimal', local: 'role_local', sent: 'role_sent', compensated: 'role_compensated' } as const;
const variantWords = { fusing: 'eve_fusing', differencing: 'eve_differencing', window_mean: 'eve_window_mean', zero: 'eve_zero' } as const;

export function variantWord(variant: string): string {
  return variant in variantWords ? t(variantWords[variant as keyof typeof variantWords]) : variant.replaceAll('_', ' ');
}

export function curveWord(curve: Pick<Curve, 'role' | 'node' | 'variant'>): string {
  if (curve.role === 'eve') return t('role_eve', { variant: variantWord(curve.variant ?? '') });
  const word = t(roleWords[curve.role]);
  return curve.node === null ? word : `${word} ${curve.node}`;
}

interface SquareOptions {
  turned: readonly string[];
  /** Whether the covariance's trace is drawn under each squared error. */
  traces: boolean;
  /** Kinds of curves that have no values. */
  without?: readonly string[];
}

function pair(curve: Curve, name: string, look: Look, traces: boolean, strong: boolean): LineSpec[] {
  const lines: LineSpec[] = [];
  if (traces && curve.trace) lines.push({ key: curve.trace, name: t('trace_of', { name }), signal: curve.trace, token: look.token, dash: look.dash, width: 0.8, map: clipped });
  if (curve.square) lines.push({ key: curve.square, name, signal: curve.square, token: look.token, dash: look.dash, width: look.width, map: clipped, strong });
  return lines;
}

/** Squared errors of all that one lane tells (figures 2-3, 2-6, 3-3). The user is drawn last: on top. */
export function laneSquares(model: RunModel, lane: LaneModel, { turned, traces, without = [] }: SquareOptions): LineSpec[] {
  const nodes = model.nodes.map(({ id }) => id);
  return curvesOf(model, lane)
    .filter(({ id }) => isShown(turned, id) && !without.includes(id))
    .toReversed()
    .flatMap((curve) => pair(curve, curveWord(curve), lookOf(curve, lane, nodes), traces, curve.role === 'fused'));
}

/** The legitimate user's squared errors in every lane (figure 4-2), and under them what is best. The overview has them all. */
export function userSquares(model: RunModel, lanes: readonly LaneModel[], chosen: LaneModel | null, { turned, traces }: SquareOptions): LineSpec[] {
  // What is best is the same in every lane; the chosen one's is streamed.
  const best = (chosen ? curvesOf(model, chosen) : []).find(({ role, square }) => role === 'optimal' && square);
  const own = lanes.flatMap((lane) =>
    curvesOf(model, lane)
      .filter(({ role }) => role === 'fused')
      .flatMap((curve) => pair(curve, laneWord(lane.id), { token: lane.token, dash: lane.dash, width: lane === chosen ? 2.2 : 1.5 }, traces, lane === chosen)),
  );
  return [...own, ...(best && isShown(turned, 'optimal') ? pair(best, t('role_optimal'), lookOf(best, { token: 'ink' }, []), traces, false) : [])];
}

/** Squared errors of those who listen, lane by lane (figures 2-4, 2-7, 4-3): whom a mechanism is meant against always, in the lane's dash, others in their own. */
export function eveSquares(model: RunModel, lanes: readonly LaneModel[], chosen: LaneModel | null, { turned, traces }: SquareOptions): LineSpec[] {
  return lanes.flatMap((lane) =>
    curvesOf(model, lane)
      .filter(({ role }) => role === 'eve')
      .flatMap((curve, i) => {
        if (i > 0 && !isShown(turned, curve.id)) return [];
        const look = { token: lane.token, dash: i === 0 ? lane.dash : lookOf(curve, lane, []).dash, width: i > 0 ? 1.1 : lane === chosen ? 2.2 : 1.5 };
        return pair(curve, `${laneWord(lane.id)}, ${variantWord(curve.variant ?? '')}`, look, traces, lane === chosen && i === 0);
      }),
  );
}

/** One component over time: true, the user's and every eavesdropper's shown (figure 2-2). */
export function trackLines(model: RunModel, lane: LaneModel, component: string, turned: readonly string[]): LineSpec[] {
  const truth = `truth.${component}`;
  const names = new Set(model.signals.map(({ name }) => name));
  const lines = curvesOf(model, lane)
    .filter(({ id, role, estimate }) => (role === 'fused' || role === 'eve') && isShown(turned, id) && names.has(estimate + component))
    .toReversed()
    .map((curve): LineSpec => ({ key: curve.estimate + component, name: curveWord(curve), signal: curve.estimate + component, ...lookOf(curve, lane, []), strong: curve.role === 'fused' }));
  return names.has(truth) ? [...lines, { key: truth, name: t('truth'), signal: truth, token: 'ink', dash: [6, 4], width: 2.2 }] : lines;
}

interface Key {
  id: string;
  word: string;
  look: Look;
  /** Signals of the squared errors, one a node. */
  squares: string[];
}

/** The kinds of curves that lanes have, one entry each: what the keys beside a chart switch. `main`: with whom a mechanism is meant against. */
export function curveKeys(model: RunModel, lanes: readonly LaneModel[], roles: readonly Curve['role'][], main = true): Key[] {
  const nodes = model.nodes.map(({ id }) => id);
  const seen = new Map<string, Key>();
  for (const lane of lanes) {
    for (const curve of curvesOf(model, lane)) {
      if (!roles.includes(curve.role) || (!main && curve.id.startsWith('eve.'))) continue;
      const key = seen.get(curve.id) ?? { id: curve.id, word: curveWord({ ...curve, node: null }), look: lookOf(curve, lane, nodes), squares: [] };
      if (curve.square) key.squares.push(curve.square);
      seen.set(curve.id, key);
    }
  }
  return [...seen.values()];
}
