/// What a menu at a place offers, in words that a hand would use.
import { language } from '../../../i18n/i18n.svelte';
import type { PlaceKind } from '../attack_places';
import { beginsAtOnce, type AttackKind } from './kinds';
import { en, t } from './words';

/** What one does most comes first; what is not named here follows in the server's order. */
const order = ['dos', 'bias', 'replay', 'eavesdrop', 'noise', 'freeze', 'ramp', 'dos_fdi'];

function isVerb(key: string): key is `verb_${string}` & keyof typeof en {
  return Object.hasOwn(en, key);
}

/** "Jam"; an attack that this page has no verb for is called by its title. */
export function verbOf(kind: Pick<AttackKind, 'id' | 'title'> | undefined, type: string): string {
  const key = `verb_${type}`;
  if (isVerb(key)) return t(key);
  return kind?.title[language.current] ?? type.replaceAll('_', ' ');
}

export interface Offer {
  kind: AttackKind;
  /** It begins with a click; else it has to be asked for something first. */
  atOnce: boolean;
}

export function offersAt(kinds: readonly AttackKind[], place: PlaceKind): Offer[] {
  const rank = (id: string): number => (order.includes(id) ? order.indexOf(id) : order.length);
  return kinds
    .filter(({ actsOn }) => actsOn.includes(place))
    .sort((a, b) => rank(a.id) - rank(b.id))
    .map((kind) => ({ kind, atOnce: beginsAtOnce(kind) }));
}
