import type { Json, JsonObject } from './json';
import { changes } from './patch';

/** A word for a POSIX shell: as it is where nothing in it is special, else in single quotes. */
export function shellWord(text: string): string {
  if (/^[A-Za-z0-9_@%+=:,./-]+$/.test(text)) return text;
  return `'${text.replaceAll("'", `'\\''`)}'`;
}

export interface Line {
  text: string;
  /** The changes go along as a file, because --set reaches only members that are there already. */
  patchFile: boolean;
}

/** The command that runs the same on the command line: every change as --set PATH=JSON, or the patch as a file. */
export function commandLine(id: string, preset: JsonObject, document: JsonObject, seed: number | undefined): Line {
  const words = ['vigil', 'run', shellWord(id)];
  if (seed !== undefined) words.push('--seed', String(seed));
  const all = changes(preset, document);
  const patchFile = all.some(({ from, to }) => from === undefined || to === undefined);
  if (patchFile) words.push('--patch', 'changes.json');
  else for (const { path, to } of all) words.push('--set', shellWord(`${path.join('.')}=${JSON.stringify(to satisfies Json | undefined)}`));
  return { text: words.join(' '), patchFile };
}
