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

/** The node that a panel on one node begins with: the chosen one, else the one attacked first, else the first. */
export function nodeShown(chosen: string | null, nodes: readonly string[], run: Pick<RunDetail, 'document'> | null): string | null {
  if (chosen !== null && nodes.includes(chosen)) return chosen;
  let first: { node: string; from: number } | null = null;
  for (const attack of Object.values((run?.document?.adversary ?? {}) as Record<string, { on?: unknown; from?: unknown } | null>)) {
    const from = typeof attack?.from === 'number' ? attack.from : 0;
    for (const place of Array.isArray(attack?.on) ? attack.on : []) {
      const node = nodes.find((id) => place === `sensor:${id}` || String(place).startsWith(`sensor:${id}.`));
      if (node !== undefined && (!first || from < first.from)) first = { node, from };
    }
  }
  return first?.node ?? nodes[0] ?? null;
}
