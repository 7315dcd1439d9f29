/// Which lane is drawn beside the chosen one.
import type { LaneModel, RunModel } from '../model';

/** The baselines that the paper compares errors with, in this order. */
const usual = ['gmeekf', 'zonotope_watermark', 'ufir_filter'];

/** The lane that was asked for; without a wish a baseline, else the first other lane. "none": none. */
export function otherLane(model: Pick<RunModel, 'lanes'>, lane: LaneModel, wanted: string | null): LaneModel | null {
  if (wanted === 'none') return null;
  const others = model.lanes.filter((one) => one !== lane);
  const asked = others.find((one) => one.id === wanted);
  const method = usual.find((name) => others.some((one) => one.method === name));
  return asked ?? others.find((one) => one.method === method) ?? others[0] ?? null;
}
