import { api } from '../../../api/client';
import { samplesSeries } from '../../../data/series';
import { rmsOf } from './figures';

const points = 4000;

/** Root mean squares of signals over one window of the run, from the log: asked again as the window fills. */
export class SignalSizes {
  values = $state.raw<ReadonlyMap<string, number>>(new Map());
  private asked = '';

  async load(run: string, names: readonly string[], from: number, to: number): Promise<void> {
    const wanted = `${run} ${from} ${to} ${names.join()}`;
    if (!names.length || to <= from || wanted === this.asked) return;
    this.asked = wanted;
    try {
      const series = samplesSeries(await api.samples(run, { signals: names.join(), from: from + 1, to, points }));
      if (this.asked !== wanted) return;
      this.values = new Map(
        names.flatMap((name): [string, number][] => {
          const own = series.get(name);
          const size = own ? rmsOf(own, from, to) : null;
          return size === null ? [] : [[name, size]];
        }),
      );
    } catch {
      // Without them the sentences that compare are left out; the next tick asks again.
      if (this.asked === wanted) this.asked = '';
    }
  }
}
