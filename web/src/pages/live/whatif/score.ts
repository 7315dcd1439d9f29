/// What flags are worth: rates over the ticks of an attack and outside it (specification of seed 003, section 6).

export interface Rates {
  /** null: nothing of the kind was there. */
  tpr: number | null;
  fpr: number | null;
  accuracy: number | null;
  /** Ticks from the attack's first to the first flag in it. */
  delay: number | null;
  /** Ticks of the longest flag in an attack. */
  longest: number | null;
  /** Accuracy of saying "no attack" always. */
  quiet: number | null;
}

export class Score {
  private ticks = 0;
  private right = 0;
  private attacked = 0;
  private hits = 0;
  private calm = 0;
  private falses = 0;
  private first = NaN;
  private last = NaN;
  private firstHit = NaN;
  private run = 0;
  private longest = 0;

  /** `from`: the first tick that may count as a false alarm. `tail`: ticks after an attack that count as neither. */
  constructor(
    private readonly from: number,
    private readonly tail: number,
  ) {}

  note(k: number, attacked: boolean, flagged: boolean): void {
    this.ticks++;
    if (flagged === attacked) this.right++;
    if (!attacked) {
      this.run = 0;
      if (k < this.from || k <= this.last + this.tail) return;
      this.calm++;
      if (flagged) this.falses++;
      return;
    }
    if (Number.isNaN(this.first)) this.first = k;
    this.last = k;
    this.attacked++;
    if (flagged) this.hits++;
    if (flagged && Number.isNaN(this.firstHit)) this.firstHit = k;
    this.run = flagged ? this.run + 1 : 0;
    this.longest = Math.max(this.longest, this.run);
  }

  get rates(): Rates {
    const share = (part: number, whole: number): number | null => (whole > 0 ? part / whole : null);
    return {
      tpr: share(this.hits, this.attacked),
      fpr: share(this.falses, this.calm),
      accuracy: share(this.right, this.ticks),
      delay: Number.isNaN(this.firstHit) ? null : this.firstHit - this.first,
      longest: this.attacked ? this.longest : null,
      quiet: share(this.ticks - this.attacked, this.ticks),
    };
  }
}
