/// What the page can see by itself: cells that are no numbers. All else is for the server to say.
import type { JsonObject } from '../../../form/json';
import { at } from '../../../form/pointer';
import { wrongCell } from '../check';
import { cellsAt, places, pointerOf, tablesOf, vectorAt } from './places';

/** Pointers of what holds a value that is no number. */
export function wrongPlaces(document: JsonObject): string[] {
  const wrong = tablesOf(document).filter((path) => wrongCell(cellsAt(document, path)) !== null);
  if (wrongCell([vectorAt(document, places.truth)])) wrong.push([...places.truth]);
  if (wrongCell([[at(document, ['time', 'dt']) ?? '']])) wrong.push(['time', 'dt']);
  const steps = at(document, ['time', 'steps']);
  if (steps !== null && steps !== undefined && wrongCell([[steps]])) wrong.push(['time', 'steps']);
  return wrong.map(pointerOf);
}
