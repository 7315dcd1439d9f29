/// Which attacks on its sensor a lane reconstructs, channel by channel, and where the true ones are told.
import { laneOf, type LaneModel, type RunModel } from '../model';

export interface Channel {
  name: string;
  unit: string;
  /** Signal of what the lane found. */
  found: string;
  /** Signal of what the adversary added; null: the run does not tell it. */
  injected: string | null;
  /** Of an angle that only counts modulo a turn, in its unit; 0: none. */
  period: number;
}

export interface Reconstruction {
  lane: LaneModel;
  nodes: { id: string; channels: Channel[] }[];
}

/** Channels that the stations and the filters wrap. */
const wrapped = new Set(['azimuth', 'bearing']);

/** What the chosen lane reconstructs; where it does not, what the first lane that does. */
export function reconstructionOf(model: RunModel, lane: string | null): Reconstruction | null {
  const chosen = laneOf(model, lane);
  for (const one of [...(chosen ? [chosen] : []), ...model.lanes]) {
    const nodes = nodesOf(model, one);
    if (nodes.length) return { lane: one, nodes };
  }
  return null;
}

function nodesOf(model: RunModel, lane: LaneModel): Reconstruction['nodes'] {
  const names = new Set(model.signals.map((signal) => signal.name));
  const own = (name: string): string | null => (names.has(`lane.${lane.id}.${name}`) ? `lane.${lane.id}.${name}` : names.has(name) ? name : null);
  return lane.outputs.flatMap((id) => {
    const prefix = `lane.${lane.id}.${id}.attack.`;
    const channels = model.signals
      .filter((signal) => signal.name.startsWith(prefix))
      .map((signal): Channel => {
        const name = signal.name.slice(prefix.length);
        const period = wrapped.has(name) ? (signal.unit === 'deg' ? 360 : 2 * Math.PI) : 0;
        return { name, unit: signal.unit, found: signal.name, injected: own(`sensor.${id}.${name}.injected`), period };
      });
    return channels.length ? [{ id, channels }] : [];
  });
}

/** A value of an angle as its representative in (-period/2, period/2]. */
export function wrap(value: number, period: number): number {
  if (!period) return value;
  const rest = value - period * Math.round(value / period);
  return rest <= -period / 2 ? rest + period : rest;
}
