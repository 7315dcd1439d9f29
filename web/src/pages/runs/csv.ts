import type { RunItem } from '../../api/types';
import { durationOf, errorsByLane } from './table';

/** A cell of a CSV file (RFC 4180). Text that a spreadsheet would run as a formula gets an apostrophe before it. */
export function cell(value: string | number | null | undefined): string {
  if (value === null || value === undefined) return '';
  if (typeof value === 'number') return String(value);
  const safe = /^[=+\-@\t\r]/.test(value) ? `'${value}` : value;
  return /[",\n\r]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}

/** The list as CSV: one row a run, one column for each lane's error figure. Times are RFC 3339, numbers in full. */
export function runsCsv(runs: readonly RunItem[], changed: (run: RunItem) => string, now: number): string {
  const figures = [...new Set(runs.flatMap((run) => errorsByLane(run).map(({ lane, name }) => `${lane}.${name}`)))];
  const head = ['id', 'state', 'scenario', 'family', 'changed', 'seed', 'k', 'steps', 'pace', 'created', 'started', 'ended', 'duration_s', 'tags', 'note', 'version', ...figures];
  const rows = runs.map((run) => {
    const values = new Map(errorsByLane(run).map(({ lane, name, value }) => [`${lane}.${name}`, value]));
    return [
      run.id, run.state, run.scenario, run.family, changed(run), run.seed, run.progress.k, run.progress.steps, run.pace, run.created,
      run.started, run.ended, durationOf(run, now), run.tags.join(' '), run.note, run.version, ...figures.map((name) => values.get(name)),
    ];
  });
  return [head, ...rows].map((row) => row.map(cell).join(',')).join('\r\n') + '\r\n';
}
