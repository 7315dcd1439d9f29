import { getContext, setContext } from 'svelte';
import type { Session } from './session.svelte';
import type { LiveView } from './view.svelte';

const key = Symbol('live');

export interface LiveContext {
  session: Session;
  view: LiveView;
}

export function provideLive(context: LiveContext): void {
  setContext(key, context);
}

export function useLive(): LiveContext {
  return getContext<LiveContext>(key);
}
