/// Thousands of lines as one picture: every pixel counts the lines that pass it, and its strength follows from the count.
/// It is worked off in slices, so that nothing else waits.

/** Steps of the table from count to strength, a line. */
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
    const { points, ratio, counts, width, height } = this;
    const last = from + 2 * (this.each - 1);
    for (let i = from; i < last; i += 2) {
      const ax = points[i]! * ratio;
      const ay = points[i + 1]! * ratio;
      const bx = points[i + 2]! * ratio;
      const by = points[i + 3]! * ratio;
      if (!(Math.abs(bx - ax) + Math.abs(by - ay) < Infinity)) continue;
      if (bx - ax >= Math.abs(by - ay)) stroke(counts, ax, ay, bx, by, width, height, 1, width);
      else if (ay < by) stroke(counts, ay, ax, by, bx, height, width, width, 1);
      else stroke(counts, by, bx, ay, ax, height, width, width, 1);
    }
  }

  /** The picture in one colour (0xAABBGGRR); n lines of this strength upon each other are 1 - (1 - alpha)^n. */
  paint(pixels: Uint32Array, abgr: number, alpha: number): void {
    const table = strengths(alpha).map((strength) => ((strength << 24) | (abgr & 0xffffff)) >>> 0);
    const { counts } = this;
    const most = table.length - 1;
    for (let i = 0; i < counts.length; i++) {
      const count = counts[i]!;
      if (count > 0) pixels[i] = table[Math.min(most, (count * kSteps + 0.5) | 0)]!;
    }
  }
}

/** Counts a line once at every whole place between a and b of its longer direction, shared between the two pixels it lies between there. `next` and `beside`: steps in `counts`. */
function stroke(counts: Float32Array, a: number, from: number, b: number, to: number, length: number, across: number, next: number, beside: number): void {
  const slope = (to - from) / (b - a);
  const first = Math.max(0, Math.ceil(a));
  const last = Math.min(length, Math.ceil(b));
  let place = from + (first - a) * slope;
  for (let i = first; i < last; i++, place += slope) {
    if (place < 0 || place >= across - 1) continue;
    const whole = place | 0;
    const share = place - whole;
    const at = i * next + whole * beside;
    counts[at] = counts[at]! + 1 - share;
    counts[at + beside] = counts[at + beside]! + share;
  }
}

function strengths(alpha: number): Uint32Array {
  return Uint32Array.from({ length: kSteps * kMostLines + 1 }, (_, i) => Math.round(255 * (1 - (1 - alpha) ** (i / kSteps))));
}
