/// Starting and stopping attacks by hand, and moving one in time. Every failure is said.
import { api } from '../../../api/client';
import { sentence } from '../../../api/problem';
import { navigate } from '../../../router/router.svelte';
import { notify } from '../../../ui/notices.svelte';
import type { LiveContext } from '../context';
import type { Proposal, Times } from './drag';
import type { Place } from './hands.svelte';
import { verbOf, type Offer } from './verbs';
import { t } from './words';

export function placeWord({ kind, id }: Pick<Place, 'kind' | 'id'>): string {
  return t(`place_${kind}`, { id: id.replace('-', '→') });
}

/** The tick that an attack on an ended run forks it at: the cursor's, as long as something comes after it. */
export function forkTick({ session, view }: LiveContext): number {
  const head = session.source?.head ?? session.status.head;
  return Math.max(0, Math.min(view.at ?? head, head - 1));
}

/** Begins with the usual parameters: now, or in a fork where the run has ended. What is refused opens the dialog. */
export async function startAt(context: LiveContext, place: Place, { kind, params }: Pick<Offer, 'kind' | 'params'>): Promise<void> {
  const { session } = context;
  const attack = { type: kind.id, on: [place.on], params };
  try {
    if (!session.live) {
      const k = forkTick(context);
      const made = await api.fork(session.id, k, { adversary: { [`hand_${k + 1}`]: { ...attack, from: k + 1 } } });
      notify(t('forked', { id: made.id, place: placeWord(place), k: k + 1 }));
      navigate(`/live/${made.id}?with=${session.id}`);
      return;
    }
    const made = await api.attack(session.id, attack);
    notify(t('started', { verb: verbOf(kind, kind.id), place: placeWord(place), ...made }), 'plain', { word: t('undo'), run: () => void stopAttack(context, made.id) });
    void session.refresh();
  } catch (error) {
    if (session.live) session.hands.wish = { kind: place.kind, place: place.id, type: kind.id, failure: sentence(error) };
    else notify(sentence(error), 'bad');
  }
}

export async function stopAttack({ session }: LiveContext, id: string): Promise<void> {
  try {
    await api.endAttack(session.id, id);
    void session.refresh();
  } catch (error) {
    notify(sentence(error), 'bad');
  }
}

/** Does what was proposed for an attack that was moved. True if it was done. */
export async function move({ session }: LiveContext, proposal: Proposal, times: Times): Promise<boolean> {
  try {
    if (proposal.kind === 'fork') {
      const made = await api.fork(session.id, proposal.k, proposal.patch);
      notify(t('move_done', { id: made.id }));
      navigate(`/live/${made.id}?with=${session.id}`);
      return true;
    }
    // The new one first: if it is refused, the old one stays.
    const made = await api.attack(session.id, proposal.attack);
    await api.endAttack(session.id, proposal.stop);
    notify(t('moved_anew', { id: made.id, k: times.from }));
    void session.refresh();
    return true;
  } catch (error) {
    notify(sentence(error), 'bad');
    return false;
  }
}
