/// Asks the server what it says of the description, a moment after the last change.
import { ApiProblem } from '../../../api/problem';
import { isObject, type JsonObject } from '../../../form/json';
import { put } from '../../../form/pointer';
import type { Refusal } from '../check';
import { checkSystem, type Report } from './report';

/** ms without a change. */
export const pause = 400;

/** A document needs a lane: where there is none yet, one stands in. */
function withLane(document: JsonObject): JsonObject {
  return isObject(document.lanes) && Object.keys(document.lanes).length ? document : put(document, ['lanes'], { any: { method: 'local_ekf' } });
}

export class Checker {
  /** Of the last description that was understood. */
  report = $state.raw<Report | null>(null);
  problem = $state.raw<unknown>(null);
  busy = $state(false);
  /** The description that the last answer is of. */
  answered = $state.raw<JsonObject | null>(null);
  private timer: ReturnType<typeof setTimeout> | undefined;
  private asked: JsonObject | null = null;

  /** Pointers into the description, which was sent as the member "scenario"; then what keeps it from starting. */
  get refusals(): readonly Refusal[] {
    if (this.problem instanceof ApiProblem) return this.problem.errors.map(({ pointer, detail }) => ({ pointer: pointer.replace(/^\/scenario(?=\/)/, ''), detail }));
    const run = this.problem === null ? this.report?.run : undefined;
    return run && !run.starts && run.pointer && run.reason ? [{ pointer: run.pointer.replace(/^\/scenario(?=\/)/, ''), detail: run.reason }] : [];
  }

  /** null: there is nothing to ask yet. */
  ask(document: JsonObject | null): void {
    clearTimeout(this.timer);
    this.asked = document;
    this.busy = document !== null;
    if (document) this.timer = setTimeout(() => void this.send(document), this.answered === null ? 0 : pause);
  }

  private async send(document: JsonObject): Promise<void> {
    let report = this.report;
    let problem: unknown = null;
    try {
      report = await checkSystem(withLane(document));
    } catch (error) {
      problem = error;
    }
    // Only the newest question's answer counts.
    if (this.asked !== document) return;
    this.report = report;
    this.problem = problem;
    this.answered = document;
    this.busy = false;
  }

  stop(): void {
    clearTimeout(this.timer);
    this.asked = null;
  }
}
