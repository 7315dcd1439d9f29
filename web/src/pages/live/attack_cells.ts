/// How link states look: a colour and a letter each, so that colour alone never carries the meaning.
export const linkStates = [
  { value: 1, letter: 'D', token: 'dos', word: 'word_D' },
  { value: 2, letter: 'F', token: 'fdi', word: 'word_F' },
  { value: 3, letter: 'R', token: 'replay', word: 'word_R' },
] as const;

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
