/// The lines of the observer family's charts: errors of own states, attacks and faults as they are and as lanes find them.
import { laneDash, laneToken } from '../../../chart/colours';
import { magnitude } from '../../../data/series';
import type { LineSpec } from '../lines';
import { laneWord, type LaneModel, type RunModel } from '../model';
import { truthFor, type Channel, type SubsystemModel } from './subsystems';

const known = (model: RunModel, name: string): boolean => model.signals.some((signal) => signal.name === name);

/** Estimate minus truth of every own state of a subsystem (seed 002, figure 2). */
export function stateErrorLines(model: RunModel, lane: LaneModel, subsystem: SubsystemModel): LineSpec[] {
  return subsystem.states.flatMap((component, i): LineSpec[] => {
    const signal = `lane.${lane.id}.${subsystem.id}.estimate.${component}`;
    const minus = truthFor(model, lane, `truth.${component}`);
    if (!known(model, signal) || !known(model, minus)) return [];
    return [{ key: signal, name: component, signal, minus, close: true, token: laneToken(i), dash: laneDash(i), width: 1.5 }];
  });
}

function foundBy(model: RunModel, lane: LaneModel, subsystem: string, { kind, name }: Channel): string | null {
  const signal = `lane.${lane.id}.${subsystem}.${kind}.${name}`;
  return known(model, signal) ? signal : null;
}

export interface LaneLines {
  lanes: readonly LaneModel[];
  /** Drawn stronger than the others. */
  chosen: LaneModel | null;
  /** Whose signals are streamed: the others' are fetched for the window. */
  streamed: LaneModel | null;
  /** How the true value is called. */
  truthWord: string;
}

/** The true attack or fault, dashed in ink, under what each lane finds. */
export function channelLines(model: RunModel, subsystem: string, channel: Channel, { lanes, chosen, streamed, truthWord }: LaneLines): LineSpec[] {
  const lines = lanes.flatMap((lane): LineSpec[] => {
    const signal = foundBy(model, lane, subsystem, channel);
    return signal ? [{ key: signal, name: laneWord(lane.id), signal, token: lane.token, dash: lane.dash, width: lane === chosen ? 2.2 : 1.5, strong: lane === chosen, unstreamed: lane !== streamed }] : [];
  });
  return channel.truth ? [...lines, { key: channel.truth, name: truthWord, signal: channel.truth, token: 'ink', dash: [6, 4], width: 2.2 }] : lines;
}

/** What each lane finds minus what was there; `size`: its absolute value. */
export function channelErrorLines(model: RunModel, subsystem: string, channel: Channel, { lanes, chosen, streamed }: LaneLines, size = false): LineSpec[] {
  if (!channel.truth) return [];
  return lanes.flatMap((lane): LineSpec[] => {
    const signal = foundBy(model, lane, subsystem, channel);
    const minus = truthFor(model, lane, channel.truth!);
    if (!signal) return [];
    return [{ key: `${signal} error`, name: laneWord(lane.id), signal, minus, close: true, ...(size ? { map: magnitude } : {}), token: lane.token, dash: lane.dash, width: lane === chosen ? 2.2 : 1.5, strong: lane === chosen, unstreamed: lane !== streamed }];
  });
}

/** Every signal that some lines are made of, once: what their CSV holds. */
export function signalsOf(lines: readonly LineSpec[]): string[] {
  return [...new Set(lines.flatMap((line) => (line.minus ? [line.signal, line.minus] : [line.signal])))];
}
