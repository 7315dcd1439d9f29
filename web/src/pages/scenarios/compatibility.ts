import type { Compatibility, Row } from '../../api/compatibility';

export interface Mark {
  /** The word's key, or null where the lane does not meet the attack. */
  meets: NonNullable<Row['cells'][string]['meets']> | null;
  /** Number of the reason, from 1; 0 where it meets. */
  reason: number;
}

export interface Line {
  row: Row;
  marks: Mark[];
}

/** The rows with reasons numbered in the order of their appearance; rows that act nowhere only where `all`. */
export function linesOf(table: Compatibility, all: boolean): { lines: Line[]; reasons: string[] } {
  const reasons: string[] = [];
  const numbered = (reason: string): number => {
    if (!reasons.includes(reason)) reasons.push(reason);
    return reasons.indexOf(reason) + 1;
  };
  const lines = table.rows
    .filter((row) => all || row.reason === null)
    .map((row) => ({
      row,
      marks: table.lanes.map(({ id }): Mark => {
        const cell = row.cells[id];
        const why = row.reason ?? cell?.reason ?? null;
        return why === null ? { meets: cell?.meets ?? null, reason: 0 } : { meets: null, reason: numbered(why) };
      }),
    }));
  return { lines, reasons };
}
