/// What a lane of the replay family is, read from its path and its parameters, never from its name.
import type { RunDetail } from '../../../api/types';
import { laneSettings, number, text, type LaneSettings } from './settings';

/** printed: the method as the paper prints it. eq29: its equation (29) read literally. changed: an honest change of it. fixed: a change to compare with. */
export type Kind = 'printed' | 'eq29' | 'changed' | 'fixed' | 'ufir' | 'gmeekf' | 'zonotope' | 'other';

const methods: Readonly<Record<string, Kind>> = { ufir_filter: 'ufir', gmeekf: 'gmeekf', zonotope_watermark: 'zonotope' };

export type Change = 'innovation' | 'zeta' | 'frozen' | 'fixed_norm' | 'fixed_square' | 'raw_step' | 'sensor' | 'control';

/** In which ways a mixed filter departs from what is printed; the path does not count as one. */
export function changesOf(settings: LaneSettings): Change[] {
  const changes: Change[] = [];
  if (text(settings, 'residual') === 'innovation') changes.push('innovation');
  if (typeof settings.params.zeta_max === 'number') changes.push('zeta');
  const threshold = text(settings, 'threshold');
  if (threshold === 'frozen' || threshold === 'fixed_norm' || threshold === 'fixed_square') changes.push(threshold);
  if (text(settings, 'dead_band') === 'raw_step') changes.push('raw_step');
  const watermark = text(settings, 'watermark');
  if ((watermark === 'sensor' || watermark === 'control') && number(settings, 'amplitude', 0) !== 0) changes.push(watermark);
  return changes;
}

export function kindOf(settings: LaneSettings | null): Kind {
  if (!settings) return 'other';
  if (settings.method !== 'mixed_filter') return methods[settings.method] ?? 'other';
  if (text(settings, 'threshold').startsWith('fixed')) return 'fixed';
  if (changesOf(settings).length) return 'changed';
  return settings.path === 'monitor' ? 'eq29' : 'printed';
}

/** Window, multiplier and dead-band of the paper's three scenarios (seed 003, section 4). */
const paperSettings: readonly (readonly [tau: number, eta: number, iota: number])[] = [
  [20, 2, 0.3],
  [15, 2, 0.1],
  [25, 2, 0.3],
];

export function paperThreshold(settings: LaneSettings): boolean {
  return paperSettings.some(([tau, eta, iota]) => tau === number(settings, 'tau', NaN) && eta === number(settings, 'eta', NaN) && iota === number(settings, 'iota', NaN));
}

/** blind: zero whatever is replayed. quiet: zero until something is replayed. */
export function blindness(run: Pick<RunDetail, 'document' | 'commands' | 'design' | 'warnings'>, lane: string): 'blind' | 'quiet' | null {
  const settings = laneSettings(run, lane);
  const design = run.design?.[lane] ?? {};
  if (settings?.method !== 'mixed_filter') return null;
  const corner = design.corner === 'zeta = inf' && text(settings, 'residual') !== 'innovation';
  if (settings.path === 'monitor') return corner ? 'quiet' : null;
  return design.blind === true || warnedBlind(run, lane) ? 'blind' : null;
}

/** Whether the run itself saw that every residual was zero. */
export function warnedBlind(run: Pick<RunDetail, 'warnings'>, lane: string): boolean {
  return (run.warnings ?? []).some((warning) => warning.startsWith(`lane ${lane}: residual identically zero`));
}

/** For how many samples the printed threshold can flag a lasting step, as the engine works it out. */
export function longestFlag(run: Pick<RunDetail, 'design'>, lane: string): number | null {
  const value = run.design?.[lane]?.longest_step_flag;
  return typeof value === 'number' ? value : null;
}

/** The controller's reference: with any but `zero` what is fed forward differs between record and replay. */
export function referenceOf(run: Pick<RunDetail, 'document'>): string {
  const controller = run.document?.controller as { params?: { reference?: unknown } } | undefined;
  return typeof controller?.params?.reference === 'string' ? controller.params.reference : 'zero';
}
