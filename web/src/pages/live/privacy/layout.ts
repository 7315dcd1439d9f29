/// Which panels of this family a run has, and how they share a wide screen.
import type { RunDetail } from '../../../api/types';
import type { RunModel } from '../model';
import { hasCentre, protectionOf } from './centre';
import { designOf } from './design';
import { linksOf } from './messages';

const publishing: readonly string[] = ['dp_centre', 'dp_sensors'];
const promising: readonly string[] = [...publishing, 'two_step'];

const protectedBy = (run: RunDetail, model: RunModel, types: readonly string[]): boolean => model.lanes.some(({ id }) => types.includes(protectionOf(run, id)));

/** Whether a lane promises differential privacy. */
export function promisesPrivacy(run: RunDetail, model: RunModel): boolean {
  return hasCentre(model) && (protectedBy(run, model, promising) || model.lanes.some(({ id }) => (designOf(run, id)?.views.length ?? 0) > 0));
}

/** Whether a lane publishes a mean under differential privacy. */
export function publishes(run: RunDetail, model: RunModel): boolean {
  return hasCentre(model) && (protectedBy(run, model, publishing) || model.lanes.some(({ id }) => designOf(run, id)?.kappa));
}

export function hasMessages(_: RunDetail, model: RunModel): boolean {
  return hasCentre(model) && linksOf(model).length > 0;
}

type Size = readonly [columns: number, rows: number];

/** Without a guarantee paths have room; with surfaces messages stand beside the errors. */
const withoutGuarantee: Readonly<Record<string, Size>> = { tracks: [5, 2], messages: [8, 1] };
const withSurfaces: Readonly<Record<string, Size>> = { tracks: [4, 1], squares: [5, 1], messages: [3, 1], releases: [4, 1], surfaces: [5, 1], events: [3, 1] };

export function sizeIn(panel: string): (run: RunDetail, model: RunModel) => Size | null {
  return (run, model) => {
    if (!hasCentre(model)) return null;
    if (publishes(run, model)) return withSurfaces[panel] ?? null;
    return promisesPrivacy(run, model) ? null : (withoutGuarantee[panel] ?? null);
  };
}
