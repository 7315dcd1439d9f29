import { api } from '../../api/client';
import type { RunItem } from '../../api/types';
import type { JsonObject } from '../../form/json';
import { changedParameters, type ChangedParameter } from './changed';

const kAtOnce = 2;

/**
 * What each run changed against its scenario. The list does not carry documents, so a row asks for its run's when it is first
 * shown, two at a time; scenarios are read once.
 */
export class ChangesOf {
  #known = $state.raw<ReadonlyMap<string, ChangedParameter[] | null>>(new Map());
  #asked = new Set<string>();
  #waiting: RunItem[] = [];
  #busy = 0;
  #scenarios = new Map<string, Promise<JsonObject | null>>();

  /** undefined: not known yet; null: cannot be told, e.g. the scenario is gone. */
  of(id: string): ChangedParameter[] | null | undefined {
    return this.#known.get(id);
  }

  want(run: RunItem): void {
    if (this.#asked.has(run.id)) return;
    this.#asked.add(run.id);
    this.#waiting.push(run);
    void this.#work();
  }

  async #work(): Promise<void> {
    if (this.#busy >= kAtOnce) return;
    this.#busy += 1;
    for (let run = this.#waiting.pop(); run; run = this.#waiting.pop()) {
      const found = await this.#find(run);
      this.#known = new Map(this.#known).set(run.id, found);
    }
    this.#busy -= 1;
  }

  async #find(run: RunItem): Promise<ChangedParameter[] | null> {
    try {
      const [scenario, detail] = await Promise.all([this.#scenario(run.scenario), api.run(run.id)]);
      return scenario ? changedParameters(scenario, detail.document as JsonObject) : null;
    } catch {
      return null;
    }
  }

  #scenario(id: string): Promise<JsonObject | null> {
    let found = this.#scenarios.get(id);
    if (!found) {
      found = api.scenario(id).then((document) => document as JsonObject, () => null);
      this.#scenarios.set(id, found);
    }
    return found;
  }
}
