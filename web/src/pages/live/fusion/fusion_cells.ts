/// Cells of the fusion raster: whom a node chose, whether it was attacked itself, whether whom it chose was.
import { emptySeries, type Series } from '../../../data/series';

export interface Choice {
  /** Index of the chosen node; -1: not the same one in all ticks of the cell. */
  node: number;
  /** State of the chooser's own sensor, 0: clean. */
  own: number;
  /** State of the chosen node's sensor, 0: clean. */
  chosen: number;
}

const states = 8;

/** A cell as one number: what a series can carry. */
export function encode({ node, own, chosen }: Choice): number {
  return (node * states + own) * states + chosen;
}

export function decode(code: number): Choice {
  const chosen = ((code % states) + states) % states;
  const rest = Math.floor(code / states);
  const own = ((rest % states) + states) % states;
  return { node: Math.floor(rest / states), own, chosen };
}

/** Reads one series at rising ticks. */
class Walker {
  private i = 0;
  constructor(private readonly series: Series) {}

  /** Lowest and highest value at tick k; null where it is not known. */
  at(k: number): { lo: number; hi: number } | null {
    const { series } = this;
    while (this.i < series.k.length && series.k[this.i]! < k) this.i++;
    if (series.k[this.i] !== k || Number.isNaN(series.hi[this.i]!)) return null;
    return { lo: series.lo[this.i]!, hi: series.hi[this.i]! };
  }
}

/**
 * One code a point of `choice`, from the states of the sensors at the same tick (null: the run does not tell them).
 * A tick whose states have not come yet has none. Of a reduced point only what is certain is told: one choice where
 * both extremes agree, an attacked choice where that node was attacked throughout.
 */
export function fusionSeries(choice: Series, own: number, sensors: readonly (Series | null)[]): Series {
  const length = choice.k.length;
  if (!length) return emptySeries;
  const walkers = sensors.map((series) => (series ? new Walker(series) : null));
  const code = new Float64Array(length).fill(NaN);
  for (let i = 0; i < length; i++) {
    const [lo, hi] = [choice.lo[i]!, choice.hi[i]!];
    if (Number.isNaN(hi)) continue;
    const at = walkers.map((walker) => (walker ? walker.at(choice.k[i]!) : clean));
    const node = lo === hi ? hi : -1;
    const mine = at[own];
    const theirs = node < 0 ? clean : at[node];
    if (mine && theirs) code[i] = encode({ node, own: mine.hi, chosen: theirs.lo });
  }
  return { k: choice.k, lo: code, hi: code, joined: choice.joined };
}

const clean = { lo: 0, hi: 0 };

/**
 * The cells of columns of `width` ticks each, as one point a column at its first tick. Where several ticks share a
 * column an attacked choice stands for all of them (it must show), else one choice that all share, else none.
 */
export function columnSeries(codes: Series, from: number, width: number, columns: number): Series {
  if (width <= 1) return codes;
  const cells = new Map<number, Choice>();
  for (let i = 0; i < codes.k.length; i++) {
    const value = codes.lo[i]!;
    const column = Math.floor((codes.k[i]! - from) / width);
    if (Number.isNaN(value) || column < 0 || column >= columns) continue;
    const here = decode(value);
    const there = cells.get(column);
    cells.set(column, there ? joinedCell(there, here) : here);
  }
  const order = [...cells.keys()].sort((a, b) => a - b);
  const lo = Float64Array.from(order, (column) => encode(cells.get(column)!));
  return { k: Float64Array.from(order, (column) => from + column * width), lo, hi: lo, joined: new Uint8Array(order.length) };
}

function joinedCell(a: Choice, b: Choice): Choice {
  const own = a.own || b.own;
  if (!a.chosen !== !b.chosen) return { ...(a.chosen ? a : b), own };
  return { node: a.node === b.node ? a.node : -1, own, chosen: a.chosen || b.chosen };
}

/** Stretches of neighbouring cells whose choice was attacked, as first and last tick. */
export function attackedChoices(codes: Series, width: number): { from: number; to: number }[] {
  const spans: { from: number; to: number }[] = [];
  for (let i = 0; i < codes.k.length; i++) {
    const value = codes.lo[i]!;
    if (Number.isNaN(value) || !decode(value).chosen) continue;
    const k = codes.k[i]!;
    const last = spans.at(-1);
    if (last && k - last.to <= width) last.to = k + width - 1;
    else spans.push({ from: k, to: k + width - 1 });
  }
  return spans;
}

/** Shares of the window: ticks that are known, choices of an attacked node among them. */
export function countChoices(codes: readonly Series[], from: number, to: number): { known: number; attacked: number } {
  let known = 0;
  let attacked = 0;
  for (const series of codes) {
    for (let i = 0; i < series.k.length; i++) {
      const value = series.lo[i]!;
      if (series.k[i]! < from || series.k[i]! > to || Number.isNaN(value)) continue;
      known++;
      if (decode(value).chosen) attacked++;
    }
  }
  return { known, attacked };
}
