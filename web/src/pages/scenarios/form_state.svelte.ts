import { api } from '../../api/client';
import type { ApiProblem } from '../../api/problem';
import { check, place, type Placed } from '../../form/check';
import type { Field } from '../../form/fields';
import { equal, isObject, type Json, type JsonObject } from '../../form/json';
import { allFields, makeGroups, startOf, type Group, type Start } from '../../form/model';
import { apply, changes, diff, type Change } from '../../form/patch';
import { at, put } from '../../form/pointer';
import { faultText } from '../../form/say';
import type { Schema } from '../../form/schema';

/** A scenario being edited: what it was, what it is now, and what is wrong with that. */
export class ScenarioForm {
  preset = $state.raw<JsonObject>({});
  document = $state.raw<JsonObject>({});
  schema = $state.raw<Schema>({});
  /** What the server said to the last attempt; stays until something is changed. */
  refused = $state.raw<ApiProblem | null>(null);

  readonly groups: Group[] = $derived(makeGroups(this.schema, this.document));
  readonly fields: Field[] = $derived(allFields(this.groups));
  readonly changes: Change[] = $derived(changes(this.preset, this.document));
  readonly patch: JsonObject = $derived(diff(this.preset, this.document));
  readonly faults: ReadonlyMap<string, string> = $derived(this.#check());
  readonly placed: Placed = $derived(place(this.refused?.errors.map(({ pointer, detail }) => ({ pointer, detail })) ?? [], this.fields));

  constructor(readonly id: string) {}

  /** Reads the scenario and its schema and applies the patch. Throws ApiProblem. */
  async load(patch: JsonObject, signal: AbortSignal): Promise<void> {
    const [answer, schema] = await Promise.all([api.scenario(this.id, signal), api.schema(this.id, signal)]);
    const body = answer as JsonObject;
    this.preset = isObject(body.document) ? body.document : body;
    this.schema = schema as Schema;
    this.document = apply(this.preset, patch) as JsonObject;
  }

  #check(): Map<string, string> {
    const faults = new Map<string, string>();
    for (const field of this.fields) {
      const fault = check(field, field.value);
      if (fault) faults.set(field.pointer, faultText(fault));
    }
    return faults;
  }

  /** Sentences for a field: the page's own first, then the server's. */
  faultsOf(pointer: string): string[] {
    const own = this.faults.get(pointer);
    const theirs = this.placed.byField.get(pointer)?.map((problem) => problem.detail) ?? [];
    return own ? [own, ...theirs] : theirs;
  }

  get firstFault(): string | undefined {
    return this.fields.find((field) => this.faults.has(field.pointer))?.pointer ?? this.placed.first;
  }

  isChanged(path: string[]): boolean {
    return !equal(at(this.preset, path), at(this.document, path));
  }

  set(path: string[], value: Json | undefined): void {
    this.replace(put(this.document, path, value));
  }

  reset(path: string[]): void {
    this.set(path, at(this.preset, path));
  }

  replace(document: JsonObject): void {
    this.document = document;
    this.refused = null;
  }

  start(): Start {
    return startOf(this.id, this.preset, this.document, this.schema);
  }
}

/** Brings a field into sight, unfolding what holds it, and puts the focus there. */
export function focusField(pointer: string): void {
  const element = document.getElementById(`f${pointer}`);
  for (let fold = element?.closest('details'); fold; fold = fold.parentElement?.closest('details')) fold.open = true;
  element?.scrollIntoView({ block: 'center' });
  (element?.querySelector('input') ?? element)?.focus();
}
