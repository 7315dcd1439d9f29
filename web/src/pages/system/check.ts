/// What the page can see by itself: cells that are no numbers. All else is for the server to say.
import type { Json } from '../../form/json';
import { matrixNames, scalarNames, signalKinds, type Cells, type SystemDraft } from './draft';
import { couplingPointer, matrixPointer, signalPointer, subsystemPointer } from './document';

const isNumber = (cell: Json): boolean => typeof cell === 'number' && Number.isFinite(cell);

/** The first cell of a table that is no number, as a person counts; null: all are. */
export function wrongCell(cells: Cells): { row: number; column: number; text: string } | null {
  for (const [i, row] of cells.entries()) {
    for (const [j, cell] of row.entries()) if (!isNumber(cell)) return { row: i + 1, column: j + 1, text: String(cell ?? '') };
  }
  return null;
}

/** Pointers of what holds a value that is no number. */
export function wrongPlaces(system: SystemDraft): string[] {
  const wrong: string[] = [];
  const test = (pointer: string, cells: Cells): void => void (wrongCell(cells) && wrong.push(pointer));
  system.subsystems.forEach((subsystem, i) => {
    for (const name of matrixNames) test(matrixPointer(i, name), subsystem.matrices[name]);
    for (const name of scalarNames) if (!(name === 'kappa' && subsystem.scalars.kappa === null)) test(matrixPointer(i, name), [[subsystem.scalars[name]]]);
    test(`${subsystemPointer(i)}/x0`, [subsystem.x0]);
    for (const kind of signalKinds) subsystem.signals[kind].forEach((pieces, channel) => test(signalPointer(i, kind, channel), pieces));
  });
  for (const coupling of system.couplings) test(couplingPointer(coupling), coupling.H);
  test('/time/dt', [[system.dt]]);
  test('/time/steps', [[system.duration]]);
  return wrong;
}

export interface Refusal {
  pointer: string;
  detail: string;
}

/** The refusals that belong to a place: those at it and below it. */
export function refusalsAt(refusals: readonly Refusal[], pointer: string): string[] {
  return refusals.filter((one) => one.pointer === pointer || one.pointer.startsWith(`${pointer}/`)).map(({ detail }) => detail);
}
