/// The server's verdicts: its own sentences in English, the same worded from its figures in Chinese.
import { language } from '../../../i18n/i18n.svelte';
import type { ControlSight, JointSight, Mode, NodeSight, Report } from './report';
import { t } from './words';

const inChinese = (): boolean => language.current === 'zh';
const listed = (modes: readonly Mode[]): string => modes.map(({ text }) => text).join(t('list_apart'));

/** What the readings of a node, or of all together, show of the plant. */
export function seen(sight: NodeSight | JointSight): string {
  if (!inChinese() || sight.observable === null) return sight.verdict;
  const who = 'id' in sight ? t('said_node', { id: sight.id }) : t('said_joint');
  if (sight.observable) return t('said_sees_all', { who });
  const modes = listed(sight.hidden ?? []);
  return t(sight.detectable ? 'said_sees_enough' : 'said_sees_not', { who, modes });
}

export function moved(control: ControlSight): string {
  if (!inChinese() || control.controllable === null) return control.verdict;
  if (control.controllable) return t('said_moves_all');
  return t(control.stabilisable ? 'said_moves_enough' : 'said_moves_not', { modes: listed(control.hidden ?? []) });
}

export function stability({ stable, verdict }: Report['plant']): string {
  return inChinese() && stable !== null ? t(stable ? 'said_stable' : 'said_unstable') : verdict;
}

export function connectivity({ connected, components, name, verdict }: Report['graph']): string {
  if (!inChinese()) return verdict;
  if (name === 'centre') return t('said_centre');
  return connected ? t('said_connected') : t('said_parted', { n: components.length, list: components.map(({ nodes }) => `{${nodes.join(', ')}}`).join(' ') });
}
