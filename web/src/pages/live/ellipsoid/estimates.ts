/// What a lane of a linear plant offers of its state: truth, estimate, and the two parts of its error, component by component.
import type { RunDetail } from '../../../api/types';
import type { Series } from '../../../data/series';
import type { LaneModel, RunModel } from '../model';
import { reach } from './ellipse';

export interface Component {
  name: string;
  unit: string;
  truth: string;
  estimate: string;
  /** Diagonal entries of the ellipsoid's shape and of the covariance; null: the lane does not publish them. */
  shape: string | null;
  covariance: string | null;
}

export interface Estimates {
  node: string;
  components: Component[];
  /** Signals of the off-diagonal entries of the first two components. */
  cross: { shape: string | null; covariance: string | null };
}

/** Of the chosen node or the lane's first; null where the lane estimates fewer than two components of its plant. */
export function estimatesOf(run: Pick<RunDetail, 'world'>, model: RunModel, lane: LaneModel, node: string | null): Estimates | null {
  const names = new Set(model.signals.map((signal) => signal.name));
  const output = lane.outputs.find((one) => one === node) ?? lane.outputs[0];
  if (output === undefined) return null;
  const prefix = `lane.${lane.id}.${output}.`;
  const known = (name: string): string | null => (names.has(name) ? name : null);
  const components = (run.world?.state ?? []).flatMap(({ name, unit }): Component[] => {
    const estimate = known(`${prefix}estimate.${name}`);
    const truth = known(`lane.${lane.id}.truth.${name}`) ?? known(`truth.${name}`);
    return estimate && truth ? [{ name, unit, truth, estimate, shape: known(`${prefix}shape.${name}.${name}`), covariance: known(`${prefix}covariance.${name}.${name}`) }] : [];
  });
  if (components.length < 2) return null;
  const pair = `${components[0]!.name}.${components[1]!.name}`;
  return { node: output, components, cross: { shape: known(`${prefix}shape.${pair}`), covariance: known(`${prefix}covariance.${pair}`) } };
}

export interface Band {
  k: Float64Array;
  joined: Uint8Array;
  middle: Float64Array;
  /** Half widths: of the bounded part, and with two standard deviations of the random part on top. */
  inner: Float64Array;
  outer: Float64Array;
}

/** The estimate with its band, at the ticks of the estimate. A part that is not published counts as zero; one that is missing makes a gap. */
export function bandOf(estimate: Series, shape: Series | null, covariance: Series | null): Band {
  const length = estimate.k.length;
  const inner = new Float64Array(length);
  const outer = new Float64Array(length);
  const at = (series: Series | null, cursor: { i: number }, k: number): number => {
    if (!series) return 0;
    while (cursor.i < series.k.length - 1 && series.k[cursor.i + 1]! <= k) cursor.i++;
    return series.k.length && series.k[cursor.i]! <= k ? series.hi[cursor.i]! : NaN;
  };
  const [m, q] = [{ i: 0 }, { i: 0 }];
  for (let i = 0; i < length; i++) {
    const k = estimate.k[i]!;
    inner[i] = reach(at(shape, m, k));
    outer[i] = inner[i]! + reach(at(covariance, q, k), 2);
  }
  return { k: estimate.k, joined: estimate.joined, middle: estimate.hi, inner, outer };
}
