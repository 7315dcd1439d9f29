/// What kind of observer each lane of a run is: told by its method and parameters, never by its name.
import type { RunDetail } from '../../../api/types';
import { laneDocument } from './record';

export type Kind = 'proposed' | 'classical' | 'printed' | 'riccati' | 'given' | 'matched' | 'other';

export function kindOf(run: Pick<RunDetail, 'document'> | null, lane: string): Kind {
  const own = laneDocument(run, lane);
  if (own?.method === 'matched_observer') return 'matched';
  if (own?.method !== 'intermediate_observer') return 'other';
  if (own.params.structure === 'classical') return 'classical';
  const gains = own.params.gains;
  return gains === 'printed' || gains === 'riccati' || gains === 'given' ? gains : 'proposed';
}

/** The bounds a lane's design starts from: two lanes with the same can be compared. */
export function presetOf(run: Pick<RunDetail, 'document'> | null, lane: string): string {
  const preset = laneDocument(run, lane)?.params.preset;
  return typeof preset === 'string' ? preset : 'ref';
}
