/// What a lane of a run is set to: the document, and the changes made while it ran.
import type { RunDetail } from '../../../api/types';
import type { Rule, RuleSettings } from '../whatif/rule';

export interface LaneSettings {
  method: string;
  path: 'loop' | 'monitor';
  params: Readonly<Record<string, unknown>>;
}

type Lanes = Record<string, { method?: unknown; path?: unknown; params?: Record<string, unknown> } | undefined>;

export function laneSettings(run: Pick<RunDetail, 'document' | 'commands'>, lane: string): LaneSettings | null {
  const own = ((run.document?.lanes ?? {}) as Lanes)[lane];
  if (!own) return null;
  const params = { ...own.params };
  const prefix = `lanes.${lane}.params.`;
  for (const { body } of run.commands ?? []) {
    for (const [path, value] of Object.entries((body.params ?? {}) as Record<string, unknown>)) if (path.startsWith(prefix)) params[path.slice(prefix.length)] = value;
  }
  return { method: String(own.method ?? ''), path: own.path === 'monitor' ? 'monitor' : 'loop', params };
}

export function number(settings: LaneSettings | null, name: string, fallback: number): number {
  const value = settings?.params[name];
  return typeof value === 'number' && Number.isFinite(value) ? value : fallback;
}

export function text(settings: LaneSettings | null, name: string): string {
  const value = settings?.params[name];
  return typeof value === 'string' ? value : '';
}

/** The rule that a lane's detector follows. `learned`: the threshold it has now, for those that learn a fixed one or are made with it. */
export function ruleOf(settings: LaneSettings | null, learned: number): RuleSettings {
  const named = text(settings, 'threshold');
  const rule: Rule = named === 'printed' || named === 'frozen' ? named : 'fixed';
  return {
    rule,
    tau: number(settings, 'tau', 20),
    eta: number(settings, 'eta', 2),
    iota: number(settings, 'iota', 0),
    deadBand: text(settings, 'dead_band') === 'raw_step' ? 'raw_step' : 'held',
    level: learned,
  };
}

/** Which ticks count for a lane's rates: as the engine counts them. */
export function countingOf(run: Pick<RunDetail, 'document'>, settings: LaneSettings | null): { from: number; tail: number } {
  const detection = (run.document?.metrics as { detection?: { from?: unknown } } | undefined)?.detection;
  const from = typeof detection?.from === 'number' ? detection.from : 50;
  return { from, tail: Math.max(0, number(settings, 'window', 1) - 1) };
}
