/// What this browser remembers. A browser that forbids storage simply forgets.
export function readPreference(key: string): string | null {
  try {
    return localStorage.getItem(`vigil.${key}`);
  } catch {
    return null;
  }
}

export function writePreference(key: string, value: string): void {
  try {
    localStorage.setItem(`vigil.${key}`, value);
  } catch {
    return;
  }
}
