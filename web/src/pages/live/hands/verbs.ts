/// What a menu at a place offers, in words that a hand would use.
import { language } from '../../../i18n/i18n.svelte';
import type { PlaceKind } from '../attack_places';
import type { Row } from '../../../api/compatibility';
import { beginsAtOnce, fittingParams, resized, type AttackKind } from './kinds';
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
  /** Parameters it begins with, beside the defaults. */
  params: Record<string, unknown>;
  /** Why it would meet nobody; null: the server did not say so. */
  reason: string | null;
}

/** `examples`: what the server says of such attacks in this run. `size`: how many numbers an attack meets there. */
export function offersAt(kinds: readonly AttackKind[], place: PlaceKind, examples: readonly Row[], size: number): Offer[] {
  const rank = (id: string): number => (order.includes(id) ? order.indexOf(id) : order.length);
  return kinds
    .filter(({ actsOn }) => actsOn.includes(place))
    .sort((a, b) => rank(a.id) - rank(b.id))
    .map((kind): Offer => {
      const row = examples.find((one) => one.attack === kind.id && one.channel === place);
      const example = row?.params ?? null;
      // A state's worth of numbers is not a place's.
      const params = example ? (kind.id === 'coordinated' ? example : resized(example, size)) : fittingParams(kind, size);
      return { kind, atOnce: example !== null || beginsAtOnce(kind), params, reason: row?.reason ?? null };
    });
}
