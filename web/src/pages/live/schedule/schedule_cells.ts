/// What happened to the sensors of a run, node by node.
import type { RunDetail } from '../../../api/types';
import { sensorCell } from '../attack_cells';
import type { RunModel } from '../model';

/** Of several ticks only the extreme is known: attacked, but not how. */
export function sensorRasterCell(value: number, several: boolean): { token: string; letter?: string } | null {
  if (!(value > 0)) return null;
  const cell = sensorCell(value);
  return several || !cell ? { token: 'attacked' } : { token: cell.token, letter: cell.letter };
}

export interface Station {
  id: string;
  state: string;
}

/** Nodes whose sensor's state the run tells, in the order of the document. */
export function stationsOf(model: Pick<RunModel, 'nodes'>): Station[] {
  return model.nodes.flatMap(({ id, state }) => (state === null ? [] : [{ id, state }]));
}

/** Whether the scenario, or an attack begun by hand, acts on sensors at all. */
export function sensorsAttacked(run: Pick<RunDetail, 'document' | 'commands'>): boolean {
  return /"sensor:/.test(JSON.stringify([run.document?.adversary ?? {}, run.commands ?? []]));
}
