/// Asking for the gains of a described system, and waiting for them.
import { designs, follow, settled, type DesignItem } from '../../api/designs';
import { ApiProblem } from '../../api/problem';
import type { JsonObject } from '../../form/json';

export class Synthesis {
  items = $state.raw<DesignItem[]>([]);
  problem = $state.raw<unknown>(null);
  busy = $state(false);
  /** The description that the answers are of. */
  asked = $state.raw<JsonObject | null>(null);
  private abort: AbortController | null = null;

  /** Pointers into the description, which was sent as the member "scenario". */
  get refusals(): readonly { pointer: string; detail: string }[] {
    return this.problem instanceof ApiProblem ? this.problem.errors.map(({ pointer, detail }) => ({ pointer: pointer.replace(/^\/scenario(?=\/)/, ''), detail })) : [];
  }
  get done(): boolean {
    return this.asked !== null && !this.busy && this.problem === null && this.items.every(settled);
  }
  get holds(): boolean {
    return this.done && this.items.every(({ state }) => state === 'done');
  }

  async start(document: JsonObject): Promise<void> {
    this.cancel();
    const abort = new AbortController();
    this.abort = abort;
    this.items = [];
    this.problem = null;
    this.busy = true;
    this.asked = document;
    try {
      const asked = await designs.ask({ scenario: document });
      if (abort.signal.aborted) return;
      this.items = asked;
      await follow(asked, (items) => (this.items = items), abort.signal);
    } catch (error) {
      if (!abort.signal.aborted) this.problem = error;
    }
    if (this.abort === abort) this.busy = false;
  }

  /** Waits no longer; the server goes on and keeps what it finds. */
  cancel(): void {
    this.abort?.abort();
    this.abort = null;
    this.busy = false;
  }

  /** The description was changed: what was refused about it may be mended. */
  forget(): void {
    this.problem = null;
  }
}
