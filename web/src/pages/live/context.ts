import { getContext, setContext } from 'svelte';
import type { Branches } from './branch/branch.svelte';
import type { Session } from './session.svelte';
import type { LiveView } from './view.svelte';

/** Exported for tests, which set the context by hand. */
export const liveKey = Symbol('live');

export interface LiveContext {
  session: Session;
  view: LiveView;
  /** Another branch drawn over the run. The header draws none and has it not. */
  branches?: Branches;
}

export function provideLive(context: LiveContext): void {
  setContext(liveKey, context);
}

export function useLive(): LiveContext {
  return getContext<LiveContext>(liveKey);
}
