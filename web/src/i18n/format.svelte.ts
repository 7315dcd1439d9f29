/// Numbers and times as text, of steady width and in the page's language. A missing number is a dash, never 0.
import { language } from './i18n.svelte';
import { significant } from './significant';

export const missing = '–';

/** Three significant digits unless asked otherwise: 8.13, 22.2, 1.20e+5. */
export function formatNumber(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return missing;
  return significant(value, digits);
}

/** Whole numbers, grouped. */
export function formatCount(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return missing;
  return new Intl.NumberFormat(language.tag, { maximumFractionDigits: 0 }).format(value);
}

/** A wall-clock instant in the reader's zone, 24 h. */
export function formatInstant(text: string | null | undefined): string {
  if (!text) return missing;
  const date = new Date(text);
  if (Number.isNaN(date.getTime())) return missing;
  return new Intl.DateTimeFormat(language.tag, {
    month: 'short',
    day: '2-digit',
    hour: '2-digit',
    minute: '2-digit',
    second: '2-digit',
    hour12: false,
  }).format(date);
}

/** Seconds as 4.2 s, 3 min 05 s, 2 h 07 min. */
export function formatDuration(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return missing;
  if (seconds < 60) return `${seconds.toFixed(1)} s`;
  const minutes = Math.floor(seconds / 60);
  if (minutes < 60) return `${minutes} min ${String(Math.floor(seconds % 60)).padStart(2, '0')} s`;
  return `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, '0')} min`;
}

/** 1.2 kB, 34 MB … in powers of 1000. */
export function formatBytes(bytes: number | null | undefined): string {
  if (bytes === null || bytes === undefined || !Number.isFinite(bytes)) return missing;
  const units = ['B', 'kB', 'MB', 'GB', 'TB'];
  let value = bytes;
  let unit = 0;
  while (value >= 1000 && unit < units.length - 1) {
    value /= 1000;
    unit++;
  }
  return `${unit === 0 ? value : significant(value, 3)} ${units[unit]}`;
}
