/// Which trials go through what was brushed on the axes of parallel coordinates.
import type { TrialTable } from './parallel';

/** From and to, in an axis' values, by the axis' name. */
export type Brushes = ReadonlyMap<string, { lo: number; hi: number }>;

/** Rows that lie within every brush; a missing value lies in none. */
export function brushed(table: TrialTable, brushes: Brushes): Int32Array {
  const count = table.axes.length;
  const tests = table.axes.flatMap(({ name }, i) => {
    const brush = brushes.get(name);
    return brush ? [{ i, ...brush }] : [];
  });
  const rows = new Int32Array(table.rows);
  let n = 0;
  for (let row = 0; row < table.rows; row++) {
    if (tests.every(({ i, lo, hi }) => table.values[row * count + i]! >= lo && table.values[row * count + i]! <= hi)) rows[n++] = row;
  }
  return rows.subarray(0, n);
}

/** With the brush of an axis set or, null, taken away. */
export function withBrush(brushes: Brushes, name: string, brush: { lo: number; hi: number } | null): Brushes {
  const next = new Map(brushes);
  if (brush) next.set(name, brush);
  else next.delete(name);
  return next;
}
