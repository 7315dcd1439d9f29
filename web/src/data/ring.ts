/// The newest frames of one stream topic, bounded. Plain typed arrays, never reactive.
///
/// A row is one frame: tick k, time t, the number n of ticks it stands for, and one value per signal (NaN: missing).
/// Rows are in order of k. Where k - n of a row is beyond the k before it, ticks are missing: a gap.
import type { Frame } from '../stream/events';

export class Ring {
  private k: Float64Array;
  private t: Float64Array;
  private n: Int32Array;
  private columns: Float64Array[];
  private head = 0;
  private size = 0;

  constructor(
    readonly signals: readonly number[],
    readonly capacity = 12_000,
  ) {
    this.k = new Float64Array(capacity);
    this.t = new Float64Array(capacity);
    this.n = new Int32Array(capacity);
    this.columns = signals.map(() => new Float64Array(capacity));
  }

  get length(): number {
    return this.size;
  }

  /** Position of logical row i (0 = oldest). */
  private at(i: number): number {
    const p = this.head + i;
    return p >= this.capacity ? p - this.capacity : p;
  }

  tick(i: number): number {
    return this.k[this.at(i)]!;
  }
  time(i: number): number {
    return this.t[this.at(i)]!;
  }
  ticks(i: number): number {
    return this.n[this.at(i)]!;
  }
  value(column: number, i: number): number {
    return this.columns[column]![this.at(i)]!;
  }

  /** First tick that the oldest row stands for; NaN when empty. */
  get first(): number {
    return this.size ? this.tick(0) - this.ticks(0) + 1 : NaN;
  }
  get last(): number {
    return this.size ? this.tick(this.size - 1) : NaN;
  }

  /** Whether row i goes on from the row before it without a missing tick. */
  joined(i: number): boolean {
    return i > 0 && this.tick(i) - this.ticks(i) <= this.tick(i - 1);
  }

  /** First row with tick >= k; length if none. */
  lower(k: number): number {
    let low = 0;
    let high = this.size;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.tick(middle) < k) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Appends a newer frame. One that is not newer is ignored (a resume may repeat the last). Answers whether it was taken. */
  push(frame: Frame): boolean {
    if (this.size && frame.k <= this.last) return false;
    if (this.size === this.capacity) {
      this.head = this.at(1);
      this.size--;
    }
    const p = this.at(this.size);
    this.size++;
    this.k[p] = frame.k;
    this.t[p] = frame.t;
    this.n[p] = frame.n;
    for (let c = 0; c < this.columns.length; c++) this.columns[c]![p] = frame.v[c] ?? NaN;
    return true;
  }

  /** Puts older rows where they belong: the fill of a gap, or what was before the first frame. Known ticks are kept as they are. */
  insert(frames: readonly Frame[]): void {
    const rows: Frame[] = [];
    for (let i = 0; i < this.size; i++) rows.push(this.row(i));
    const known = new Set(rows.map((row) => row.k));
    for (const frame of frames) if (!known.has(frame.k)) rows.push(frame);
    rows.sort((a, b) => a.k - b.k);
    this.clear();
    for (const row of rows.slice(-this.capacity)) this.push(row);
  }

  clear(): void {
    this.head = 0;
    this.size = 0;
  }

  private row(i: number): Frame {
    const v = new Float64Array(this.columns.length);
    for (let c = 0; c < v.length; c++) v[c] = this.value(c, i);
    return { k: this.tick(i), t: this.time(i), n: this.ticks(i), v };
  }
}
