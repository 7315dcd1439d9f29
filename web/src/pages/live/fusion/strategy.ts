/// One node's game at one tick, as rows to show.
import type { Chooser } from './game';

export interface StrategyRow {
  id: string;
  probability: number;
  /** 0 to 1: length of its bar, the utility's place between the least and the greatest. */
  utilityShare: number;
  utility: number;
  taken: boolean;
  /** State of the candidate's sensor; 0: clean. */
  state: number;
}

export interface Strategy {
  rows: StrategyRow[];
  /** Whether no candidate has a probability: there was no game at this tick. */
  idle: boolean;
  /** All utilities are equal: the game does not prefer anybody. */
  uniform: boolean;
}

/** `read` answers a signal's value at the tick, NaN where there is none; `choice` is the id of the node that was taken. */
export function strategyAt(chooser: Chooser, read: (signal: string) => number, choice: string | undefined, stateOf: (id: string) => number): Strategy {
  const given = chooser.candidates
    .map((candidate) => ({ id: candidate.id, probability: candidate.probability === null ? NaN : read(candidate.probability), utility: candidate.utility === null ? NaN : read(candidate.utility) }))
    .filter(({ probability }) => Number.isFinite(probability));
  const utilities = given.map(({ utility }) => utility).filter(Number.isFinite);
  const least = Math.min(...utilities);
  const most = Math.max(...utilities);
  const rows = given.map(({ id, probability, utility }): StrategyRow => {
    const share = most > least ? (utility - least) / (most - least) : 1;
    return { id, probability, utility, utilityShare: Number.isFinite(utility) ? share : 0, taken: id === choice, state: stateOf(id) };
  });
  return { rows, idle: rows.length === 0, uniform: rows.length > 1 && most === least };
}
