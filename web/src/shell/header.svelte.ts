/// What the open page puts into the header: its identity on the left, its controls after it.
import type { Snippet } from 'svelte';

let content = $state.raw<Snippet | null>(null);

export const header = {
  get content(): Snippet | null {
    return content;
  },
  /** Call inside $effect; the answer clears it again. */
  show(snippet: Snippet): () => void {
    content = snippet;
    return () => {
      if (content === snippet) content = null;
    };
  },
};
