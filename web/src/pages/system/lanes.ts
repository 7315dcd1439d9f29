/// The lanes that a system of one's own can have, and what they are set to.
import type { JsonObject } from '../../form/json';

export const laneChoices: Readonly<Record<string, { method: string; params: JsonObject }>> = {
  intermediate_ref: { method: 'intermediate_observer', params: { structure: 'proposed', gains: 'design', preset: 'ref' } },
  intermediate_fast: { method: 'intermediate_observer', params: { structure: 'proposed', gains: 'design', preset: 'fast' } },
  classical_ref: { method: 'intermediate_observer', params: { structure: 'classical', gains: 'design', preset: 'ref' } },
  classical_fast: { method: 'intermediate_observer', params: { structure: 'classical', gains: 'design', preset: 'fast' } },
  riccati: { method: 'intermediate_observer', params: { structure: 'proposed', gains: 'riccati' } },
  matched_uio: { method: 'matched_observer', params: {} },
};
