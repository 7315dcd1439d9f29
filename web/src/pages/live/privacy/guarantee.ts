/// What a guarantee says of every observer: exactly, and as this run's noise has it (specification, 1.6, 3.5 and 4.5).
import type { RunDetail } from '../../../api/types';
import type { LaneModel, RunModel } from '../model';
import { known } from './centre';
import { designOf, type PrivacyDesign, type View } from './design';
import { shareAbove, type Share } from './normal';
import { t } from './words';
import type { en } from './words_en';

export interface GuaranteeRow extends View {
  /** mu <= 1 / gamma; null: there is no design value. */
  withinMu: boolean | null;
  /** (epsilon, delta) by the exact law; null: the design does not say. */
  withinDp: boolean | null;
  /** Signal of the sampled losses. */
  signal: string | null;
}

/** The last digits of a design value may differ from those of its mu. */
const rounding = 1e-9;

export function lossSignal(model: RunModel, lane: string, view: Pick<View, 'node' | 'name'>): string | null {
  return known(model, `lane.${lane}.${view.node}.loss.${view.name}`);
}

export function rowsOf(design: PrivacyDesign, model: RunModel, lane: string): GuaranteeRow[] {
  const { designMu, epsilon } = design;
  return design.views.map((view) => ({
    ...view,
    withinMu: designMu === null ? null : view.mu <= designMu * (1 + rounding),
    withinDp: view.mu === Infinity ? false : view.epsAtDelta === null || epsilon === null ? null : view.epsAtDelta <= epsilon * (1 + rounding),
    signal: lossSignal(model, lane, view),
  }));
}

/** The share of sampled losses beyond epsilon. */
export function sampledShare(values: readonly number[], epsilon: number | null): Share | null {
  return epsilon === null ? null : shareAbove(values, epsilon);
}

/** Lanes whose design says what observers learn. */
export function guaranteedLanes(run: Pick<RunDetail, 'design'> | null, lanes: readonly LaneModel[]): LaneModel[] {
  return lanes.filter(({ id }) => (designOf(run, id)?.views.length ?? 0) > 0);
}

const aliases: Readonly<Record<string, string>> = { diff: 'difference', mean_diff: 'mean_difference' };

/** A view's name in the reader's words. */
export function viewWord(name: string): string {
  const key = `view_${aliases[name] ?? name}` as keyof typeof en;
  const word = t(key);
  return word === key ? name.replaceAll('_', ' ') : word;
}

export function nodeWord(node: string): string {
  return node === 'fused' ? t('node_fused') : node;
}
