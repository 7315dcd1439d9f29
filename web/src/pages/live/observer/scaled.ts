import { countedFrom } from '../../../chart/scale';
import type { Session } from '../session.svelte';
import type { LiveView } from '../view.svelte';
import { peakSeconds } from './subsystems';
import { t } from './words';

/** Says so where the scale leaves out what the window shows of the first moments; else nothing. */
export function scaledNote(session: Session, view: LiveView, settled: number): string {
  const { from, to } = view.window(session.status.head);
  return countedFrom(from, to, settled) > from ? t('scaled', { seconds: peakSeconds }) : '';
}
