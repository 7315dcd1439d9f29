/// What a run tells of its subsystems: which signals belong to whom, how large they are, and who drives whom.
import type { RunDetail } from '../../../api/types';
import type { LaneModel, RunModel } from '../model';

/** An attack or a fault of one subsystem: what was there, and where a lane says what it finds. */
export interface Channel {
  kind: 'attack' | 'fault';
  name: string;
  /** Signal of the true one; null: the run does not tell it. */
  truth: string | null;
}

export interface SubsystemModel {
  id: string;
  /** Components of its own state, as estimates name them: x2_1. */
  states: string[];
  channels: Channel[];
  /** Sizes of state, output, attack, fault, disturbance. */
  sizes: { n: number; p: number; q: number; g: number; dd: number };
}

const ownState = /^lane\.[^.]+\.([^.]+)\.estimate\.(x\d+_\d+)$/;
const found = /^lane\.[^.]+\.([^.]+)\.(attack|fault)\.([^.]+)$/;

/** Whether the run is about subsystems that each estimate a state of their own. */
export function hasSubsystems(model: RunModel): boolean {
  return model.signals.some((signal) => ownState.test(signal.name));
}

export function subsystemsOf(model: RunModel): SubsystemModel[] {
  const states = gather(model, ownState, (match) => match[2]!);
  const channels = gather(model, found, (match) => `${match[2]}.${match[3]}`);
  const names = new Set(model.signals.map((signal) => signal.name));
  const count = (prefix: string, rest: RegExp): number => model.signals.filter(({ name }) => name.startsWith(prefix) && rest.test(name.slice(prefix.length))).length;
  return [...states].map(([id, own]) => ({
    id,
    states: [...own],
    channels: [...(channels.get(id) ?? [])].map((text): Channel => {
      const [kind, name] = text.split('.') as ['attack' | 'fault', string];
      const truth = kind === 'attack' ? `actuator.${id}.${name}.injected` : `fault.${id}.${name}`;
      return { kind, name, truth: names.has(truth) ? truth : null };
    }),
    sizes: {
      n: own.size,
      p: count(`sensor.${id}.`, /^y\d+$/),
      q: count(`actuator.${id}.`, /^w\d+\.injected$/) || [...(channels.get(id) ?? [])].filter((text) => text.startsWith('attack.')).length,
      g: count(`fault.${id}.`, /^f\d+$/),
      dd: count(`disturbance.${id}.`, /^d\d+$/),
    },
  }));
}

function gather(model: RunModel, pattern: RegExp, take: (match: RegExpExecArray) => string): Map<string, Set<string>> {
  const result = new Map<string, Set<string>>();
  for (const { name } of model.signals) {
    const match = pattern.exec(name);
    if (!match) continue;
    const own = result.get(match[1]!) ?? new Set();
    own.add(take(match));
    result.set(match[1]!, own);
  }
  return result;
}

/** A signal of a lane where it has its own, else the shared one. */
export function truthFor(model: RunModel, lane: LaneModel, name: string): string {
  const own = `lane.${lane.id}.${name}`;
  return model.signals.some((signal) => signal.name === own) ? own : name;
}

export interface Arrow {
  from: string;
  to: string;
}

type Plant = { type?: unknown; params?: { couplings?: Record<string, unknown>; topology?: unknown } };

/** Who drives whom: as the document couples them, else as the plant of an example is known to be. */
export function couplingsOf(run: Pick<RunDetail, 'document' | 'world'>, ids: readonly string[]): Arrow[] {
  const plant = (run.document?.plant ?? {}) as Plant;
  const written = plant.params?.couplings;
  if (written && typeof written === 'object') {
    return Object.keys(written).flatMap((key) => {
      const pair = ids.flatMap((from) => ids.filter((to) => key === `${from}-${to}`).map((to) => ({ from, to })));
      return pair.slice(0, 1);
    });
  }
  const links = (run.world?.links ?? []).filter(({ from, to }) => ids.includes(from) && ids.includes(to)).map(({ from, to }) => ({ from, to }));
  if (links.length) return links;
  const every = ids.flatMap((from, i) => ids.flatMap((to, j) => (i === j ? [] : [{ from, to, apart: Math.abs(i - j) }])));
  const ring = plant.params?.topology === 'ring';
  return every.filter(({ apart }) => !ring || apart === 1 || apart === ids.length - 1).map(({ from, to }) => ({ from, to }));
}

/** Ticks after the start in which an observer of high gain may peak: they do not stretch the scales. */
export const peakSeconds = 0.5;

export function settledTick(run: Pick<RunDetail, 'progress'> | null): number {
  const dt = run?.progress.dt ?? 0;
  return dt > 0 ? Math.round(peakSeconds / dt) : 0;
}
