/// What a lane's alarm says, tick by tick, against the truth: hits, misses, false alarms.
import type { Series } from '../../../data/series';

/** uncounted: a flag at the start, or so shortly after an attack that it still holds replayed readings. unknown: the detector cannot say yet. */
export type Sign = 'hit' | 'miss' | 'false' | 'uncounted' | 'unknown';

export interface Counting {
  /** First tick that may count as a false alarm. */
  from: number;
  /** Ticks after an attack that count as neither. */
  tail: number;
}

export interface Stretch {
  /** First and last tick. */
  from: number;
  to: number;
  sign: Sign;
}

/** First and last tick that point i stands for: of reduced samples up to the next one, of a thinned frame back to the one before. */
function span(series: Series, i: number): [number, number] {
  const k = series.k[i]!;
  if (series.lo === series.hi) return [series.joined[i] ? series.k[i - 1]! + 1 : k, k];
  const next = series.k[i + 1];
  return [k, next !== undefined && series.joined[i + 1] ? Math.max(k, next - 1) : k];
}

/** null: rightly quiet. */
export function signOf(alarm: number, attacked: boolean, k: number, lastAttacked: number, counting: Counting): Sign | null {
  if (Number.isNaN(alarm)) return 'unknown';
  if (attacked) return alarm > 0 ? 'hit' : 'miss';
  if (!(alarm > 0)) return null;
  return k < counting.from || k - lastAttacked <= counting.tail ? 'uncounted' : 'false';
}

/** Ticks of one sign that follow each other, as one. `state` is above zero where attacked; without it nothing ever is. */
export function stretchesOf(alarm: Series, state: Series | null, counting: Counting): Stretch[] {
  const result: Stretch[] = [];
  let lastAttacked = -Infinity;
  let j = 0;
  for (let i = 0; i < alarm.k.length; i++) {
    const [from, to] = span(alarm, i);
    while (state && j < state.k.length && state.k[j]! <= to) {
      if (state.hi[j]! > 0) lastAttacked = span(state, j)[1];
      j++;
    }
    const attacked = lastAttacked >= from;
    const sign = signOf(alarm.hi[i]!, attacked, to, lastAttacked, counting);
    if (!sign) continue;
    const last = result.at(-1);
    if (last && last.sign === sign && last.to >= from - 1) last.to = to;
    else result.push({ from, to, sign });
  }
  return result;
}

export interface Crossing {
  k: number;
  /** Up into an attack's flag, up without an attack, or down while the attack goes on. */
  kind: 'hit' | 'false' | 'lost';
}

/** Where the statistic crosses its threshold, as far as it matters. */
export function crossingsOf(stretches: readonly Stretch[]): Crossing[] {
  return stretches.flatMap(({ from, sign }, i): Crossing[] => {
    const previous = stretches[i - 1];
    const before = previous?.to === from - 1 ? previous.sign : null;
    const wasUp = before === 'hit' || before === 'false' || before === 'uncounted';
    if ((sign === 'hit' || sign === 'false') && !wasUp) return [{ k: from, kind: sign }];
    return sign === 'miss' && wasUp ? [{ k: from, kind: 'lost' }] : [];
  });
}
