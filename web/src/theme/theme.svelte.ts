/// The page's theme: light, dark, or the system's. The address wins over what was chosen earlier.
import { readQuery, setQuery } from '../router/router.svelte';
import { readPreference, writePreference } from './preferences';

export type ThemeChoice = 'light' | 'dark' | 'system';

const media = typeof matchMedia === 'function' ? matchMedia('(prefers-color-scheme: dark)') : null;

function isChoice(value: string | null): value is ThemeChoice {
  return value === 'light' || value === 'dark' || value === 'system';
}

function initial(): ThemeChoice {
  const asked = readQuery('theme');
  if (isChoice(asked)) return asked;
  const kept = readPreference('theme');
  return isChoice(kept) ? kept : 'system';
}

let choice = $state<ThemeChoice>(initial());
let systemDark = $state(media?.matches ?? false);
media?.addEventListener('change', (event) => {
  systemDark = event.matches;
  apply();
});

export const theme = {
  get choice(): ThemeChoice {
    return choice;
  },
  /** What is drawn: never "system". Canvas panels read this to redraw in the new colours. */
  get shown(): 'light' | 'dark' {
    return choice === 'system' ? (systemDark ? 'dark' : 'light') : choice;
  },
  set(next: ThemeChoice): void {
    choice = next;
    writePreference('theme', next);
    setQuery({ theme: next === 'system' ? null : next });
    apply();
  },
  /** Light, dark, system, light, … */
  next(): void {
    theme.set(choice === 'light' ? 'dark' : choice === 'dark' ? 'system' : 'light');
  },
};

function apply(): void {
  document.documentElement.dataset.theme = theme.shown;
}

apply();
