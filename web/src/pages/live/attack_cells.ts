/// How link states look: a colour and a letter each, so that colour alone never carries the meaning.
export const linkStates = [
  { value: 1, letter: 'D', token: 'dos', word: 'word_D' },
  { value: 2, letter: 'F', token: 'fdi', word: 'word_F' },
  { value: 3, letter: 'R', token: 'replay', word: 'word_R' },
] as const;

/** How the states of a node's sensor look; a link's states come first. Types I, II and R falsify range, or range and azimuth. */
export const sensorStates = [
  ...linkStates,
  { value: 4, letter: 'I', token: 'type-1', word: 'word_I' },
  { value: 5, letter: 'II', token: 'type-2', word: 'word_II' },
  { value: 6, letter: 'R', token: 'type-r', word: 'word_range' },
] as const;

export function sensorCell(value: number): { token: string; letter: string } | null {
  return sensorStates.find((state) => state.value === value) ?? null;
}

/** Of several ticks only the extreme is known: attacked, but not how. */
export function linkRasterCell(value: number, several: boolean): { token: string; letter?: string } | null {
  if (several) return value > 0 ? { token: 'attacked' } : null;
  return linkCell(value);
}

export function linkCell(value: number): { token: string; letter: string } | null {
  return linkStates.find((state) => state.value === value) ?? null;
}

/** How many packets a node lost of those its links carry: none, some or all. */
export function lostCell(links: number): (value: number) => { token: string; letter?: string } | null {
  return (value) => (value <= 0 ? null : { token: value >= links ? 'lost-all' : 'lost-some', letter: String(value) });
}

/** Conditions: 1 holds, 0 fails. */
export function conditionCell(value: number): { token: string; letter?: string; letterToken?: string } {
  return value > 0.5 ? { token: 'cell-holds' } : { token: 'cell-fails', letter: '×', letterToken: 'ink' };
}
