import type { Json, JsonObject } from './json';
import { changes } from './patch';

/** A word for a POSIX shell: as it is where nothing in it is special, else in single quotes. */
export function shellWord(text: string): string {
  if (/^[A-Za-z0-9_@%+=:,./-]+$/.test(text)) return text;
  return `'${text.replaceAll("'", `'\\''`)}'`;
}

export interface Line {
  text: string;
  /** Changes that --set cannot say: members taken out of the preset. */
  left: string[];
}

/** The command that runs the same on the command line: every change as --set PATH=JSON. */
export function commandLine(id: string, preset: JsonObject, document: JsonObject, seed: number | undefined): Line {
  const words = ['vigil', 'run', shellWord(id)];
  const left: string[] = [];
  if (seed !== undefined) words.push('--seed', String(seed));
  for (const { path, to } of changes(preset, document)) {
    if (to === undefined) left.push(path.join('.'));
    else words.push('--set', shellWord(`${path.join('.')}=${JSON.stringify(to satisfies Json)}`));
  }
  return { text: words.join(' '), left };
}
