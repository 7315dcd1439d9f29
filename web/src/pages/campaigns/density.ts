/// Thousands of lines as one picture: every pixel counts the lines that pass it, and its strength follows from the count.
/// It is worked off in slices, so that nothing else waits.

/** Steps of the table from count to strength, to each line. */
const kSteps = 16;
const kMostLines = 256;
/** Lines between two looks at the clock. */
const kAtOnce = 64;

export class LineDensity {
  readonly counts: Float32Array;
  #next = 0;
  readonly #lines: number;

  /** Size in device pixels; `points` are x and y by turns in CSS pixels, `each` points a line, from left to right. */
  constructor(
    readonly width: number,
    readonly height: number,
    private readonly points: Float32Array,
    private readonly each: number,
    private readonly ratio: number,
  ) {
    this.counts = new Float32Array(width * height);
    this.#lines = each > 0 ? Math.floor(points.length / (2 * each)) : 0;
  }

  /** Goes on for so many ms at most; true once all lines are counted. */
  work(ms: number, now: () => number = () => performance.now()): boolean {
    const end = now() + ms;
    while (this.#next < this.#lines) {
      const stop = Math.min(this.#lines, this.#next + kAtOnce);
      for (; this.#next < stop; this.#next++) this.#line(this.#next * this.each * 2);
      if (now() >= end) break;
    }
    return this.#next >= this.#lines;
  }

  #line(from: number): void {
    for (let i = from; i < from + 2 * (this.each - 1); i += 2) {
      const { points, ratio } = this;
      const [ax, ay, bx, by] = [points[i]! * ratio, points[i + 1]! * ratio, points[i + 2]! * ratio, points[i + 3]! * ratio];
      if (!(Math.abs(bx - ax) + Math.abs(by - ay) < Infinity)) continue;
      if (Math.abs(bx - ax) >= Math.abs(by - ay)) this.#flat(ax, ay, bx, by);
      else if (ay < by) this.#steep(ax, ay, bx, by);
      else this.#steep(bx, by, ax, ay);
    }
  }

  /** A count a column, shared between the two pixels it lies between. */
  #flat(ax: number, ay: number, bx: number, by: number): void {
    const slope = (by - ay) / (bx - ax);
    const last = Math.min(this.width, Math.ceil(bx));
    for (let x = Math.max(0, Math.ceil(ax)); x < last; x++) {
      const y = ay + (x - ax) * slope;
      const row = Math.floor(y);
      if (row < 0 || row >= this.height - 1) continue;
      const at = row * this.width + x;
      this.counts[at]! += 1 - (y - row);
      this.counts[at + this.width]! += y - row;
    }
  }

  #steep(ax: number, ay: number, bx: number, by: number): void {
    const slope = (bx - ax) / (by - ay);
    const last = Math.min(this.height, Math.ceil(by));
    for (let y = Math.max(0, Math.ceil(ay)); y < last; y++) {
      const x = ax + (y - ay) * slope;
      const column = Math.floor(x);
      if (column < 0 || column >= this.width - 1) continue;
      const at = y * this.width + column;
      this.counts[at]! += 1 - (x - column);
      this.counts[at + 1]! += x - column;
    }
  }

  /** The picture in one colour (0xAABBGGRR); n lines of this strength upon each other are 1 - (1 - alpha)^n. */
  paint(pixels: Uint32Array, abgr: number, alpha: number): void {
    const table = strengths(alpha);
    const plain = abgr & 0xffffff;
    for (let i = 0; i < this.counts.length; i++) {
      const count = this.counts[i]!;
      pixels[i] = count === 0 ? 0 : ((table[Math.min(table.length - 1, Math.round(count * kSteps))]! << 24) | plain) >>> 0;
    }
  }
}

function strengths(alpha: number): Uint8Array {
  return Uint8Array.from({ length: kSteps * kMostLines + 1 }, (_, i) => Math.round(255 * (1 - (1 - alpha) ** (i / kSteps))));
}
