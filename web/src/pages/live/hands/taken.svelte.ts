/// What can be taken in a run, and what is said of it: shared by every drawing of the network.
import { valueAt } from '../../../data/series';
import { linkStates, sensorStates } from '../attack_cells';
import type { LiveContext } from '../context';
import { t as live } from '../words';
import { placesAt, targetsOf } from './hands.svelte';
import { t } from './words';

/** The tick that the page shows the state of. */
export function tickShown({ session, view }: LiveContext): number {
  const head = session.source?.head ?? 0;
  return Math.min(view.at ?? view.window(head).to, head);
}

/** The state at a tick of a link, or of a node's sensor; NaN: not told. */
export function stateAt({ session }: LiveContext, target: string, k: number): number {
  const id = target.slice(target.indexOf(':') + 1);
  const model = session.model!;
  const signal = (target.startsWith('link:') ? model.links : model.nodes).find((one) => one.id === id)?.state;
  return signal && session.source ? valueAt(session.source.near(signal, k - 1, k), k, 1) : NaN;
}

function stateWord(target: string, value: number): string {
  const found = (target.startsWith('link:') ? linkStates : sensorStates).find((state) => state.value === value);
  return found ? live(found.word) : value === 0 ? t('clean') : '';
}

/** "Link 1→2, jammed" */
export function targetWord(context: LiveContext, target: string): string {
  const id = target.slice(target.indexOf(':') + 1);
  const places = placesAt(context.session.model!, target);
  const place = target.startsWith('link:') ? t('place_link', { id: id.replace('-', '→') }) : places.length === 1 ? t(`place_${places[0]!.kind}`, { id }) : t('place_node', { id });
  const state = stateWord(target, stateAt(context, target, tickShown(context)));
  return state ? t('place_state', { place, state }) : place;
}

/** Ids of what can be taken. */
export function takenSet({ session }: LiveContext): ReadonlySet<string> {
  return new Set(session.model ? targetsOf(session.model) : []);
}
