/// The card's sentences: what a lane does, whether it can see a replay, and what this run says of it.
import type { Metric, RunDetail } from '../../../api/types';
import { formatNumber } from '../../../i18n/format.svelte';
import { percent } from '../reconstruction/quality';
import { runMetric } from '../metrics';
import { blindness, changesOf, kindOf, longestFlag, paperThreshold, referenceOf, warnedBlind } from './facts';
import { laneSettings, number, text } from './settings';
import type { en } from './words';

export interface Sentence {
  key: keyof typeof en;
  values?: Record<string, string | number>;
  /** good and bad say it in a colour, too. */
  tone?: 'bad' | 'good';
}

type Run = Pick<RunDetail, 'document' | 'commands' | 'design' | 'warnings'>;

/** Whether it is the paper's method, in one line. */
export function heading(run: Run, lane: string): Sentence {
  const settings = laneSettings(run, lane);
  const kind = kindOf(settings);
  if (kind === 'changed') return { key: settings!.path === 'monitor' ? 'is_changed_eq29' : 'is_changed' };
  return { key: `is_${kind}` };
}

/** The path, and every change against what is printed. */
export function doings(run: Run, lane: string): Sentence[] {
  const settings = laneSettings(run, lane);
  const kind = kindOf(settings);
  if (!settings) return [];
  if (kind === 'ufir') return [{ key: 'does_ufir', values: { n: number(settings, 'N', 10) } }, { key: 'no_detector' }];
  if (kind === 'gmeekf') return [{ key: 'does_gmeekf', values: { alpha: number(settings, 'alpha', 2), beta: number(settings, 'beta', 2), form: text(settings, 'form') } }, { key: 'no_detector' }];
  if (kind === 'zonotope') return [{ key: 'does_zonotope', values: { rho: number(settings, 'rho', 3) } }];
  if (kind === 'other') return [];
  const path: Sentence = { key: settings.path === 'monitor' ? 'path_monitor' : 'path_loop' };
  const changes = changesOf(settings).map((change): Sentence => {
    if (change === 'zeta') return { key: number(settings, 'mu', 0.5) === 1 ? 'change_zeta_idle' : 'change_zeta', values: { zeta: number(settings, 'zeta_max', 1) } };
    return { key: `change_${change}`, values: { a: number(settings, 'amplitude', 0) } };
  });
  const values = { tau: number(settings, 'tau', 20), eta: number(settings, 'eta', 2), iota: number(settings, 'iota', 0) };
  const fixed = text(settings, 'threshold').startsWith('fixed');
  const numbers: Sentence[] = fixed ? [] : [{ key: paperThreshold(settings) ? 'numbers_paper' : 'numbers_own', values }];
  return [path, ...changes, ...numbers];
}

/** Whether the detector can see a replay, and whether its threshold can hold a flag. */
export function abilities(run: Run, lane: string): Sentence[] {
  const settings = laneSettings(run, lane);
  if (settings?.method !== 'mixed_filter') return [];
  const found: Sentence[] = [];
  const blind = blindness(run, lane);
  if (blind === 'blind') found.push({ key: 'blind', tone: 'bad' });
  if (blind === 'blind' && warnedBlind(run, lane)) found.push({ key: 'blind_seen', tone: 'bad' });
  if (blind === 'quiet') found.push({ key: 'quiet' });
  const marked = changesOf(settings).some((change) => change === 'sensor' || change === 'control');
  if (blind === null && settings.path === 'loop' && !marked) {
    const reference = referenceOf(run);
    found.push(reference === 'zero' ? { key: 'stealthy', tone: 'bad' } : { key: 'stealthy_reference', values: { reference } });
  }
  if (blind !== 'blind') found.push(threshold(run, lane, text(settings, 'threshold')));
  return found;
}

function threshold(run: Run, lane: string, rule: string): Sentence {
  if (rule === 'frozen') return { key: 'holds_frozen', tone: 'good' };
  if (rule.startsWith('fixed')) return { key: 'holds_fixed' };
  const n = longestFlag(run, lane);
  if (n === null) return { key: 'holds_unknown' };
  return n > 0 ? { key: 'holds_printed', values: { n }, tone: 'bad' } : { key: 'holds_never', tone: 'bad' };
}

/** What this run has measured so far. `quiet`: accuracy of saying "no attack" always; null: not known. */
export function measured(metrics: readonly Metric[], lane: string, quiet: number | null): Sentence[] {
  const at = (name: string): number | null => {
    const value = runMetric(metrics, lane, name);
    return typeof value === 'number' ? value : null;
  };
  const [tpr, fpr, accuracy, event, without] = ['tpr', 'fpr', 'accuracy', 'event', 'event_without_attack'].map(at);
  if (typeof accuracy !== 'number') return [];
  const said: Sentence[] = [];
  if (typeof tpr === 'number' && typeof fpr === 'number') said.push({ key: 'measured_rates', values: { tpr: percent(tpr), fpr: percent(fpr) } });
  else if (typeof fpr === 'number') said.push({ key: 'measured_calm', values: { fpr: percent(fpr) } });
  if (quiet !== null && typeof tpr === 'number') said.push({ key: 'measured_accuracy', values: { accuracy: percent(accuracy), quiet: percent(quiet) } });
  if (event === 1 && without === 1) said.push({ key: 'event_says_nothing' });
  return said;
}

/** The steady gain in one line; null where the lane has none. */
export function gainText(run: Pick<RunDetail, 'design'>, lane: string): string | null {
  const design = run.design?.[lane];
  const gain = design?.K;
  if (!Array.isArray(gain) || !gain.every((row) => Array.isArray(row))) return null;
  const rows = (gain as unknown[][]).map((row) => row.map((value) => formatNumber(typeof value === 'number' ? value : null)).join(' '));
  const zeta = typeof design?.zeta === 'number' ? formatNumber(design.zeta) : '∞';
  return `K = [${rows.join('; ')}], ζ = ${zeta}`;
}
