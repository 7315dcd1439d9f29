import { api } from '../../api/client';
import { sentence } from '../../api/problem';
import { notify } from '../../ui/notices.svelte';
import type { Session } from './session.svelte';

/** Asks the server for a change of the run and shows what it says. True if it was done. */
export async function changeRun(session: Session, changes: Record<string, unknown>): Promise<boolean> {
  try {
    session.take(await api.change(session.id, changes));
    return true;
  } catch (error) {
    notify(sentence(error), 'bad');
    return false;
  }
}
