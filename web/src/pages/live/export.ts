/// Saving what a panel shows.
import { api } from '../../api/client';
import { ApiProblem } from '../../api/problem';

export function saveBlob(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const anchor = document.createElement('a');
  anchor.href = url;
  anchor.download = name;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** The window of some signals as the server's own CSV, at full precision. */
export async function saveCsv(run: string, signals: readonly string[], from: number, to: number, name: string): Promise<void> {
  const url = api.samplesAddress(run, { signals: signals.join(','), from: Math.max(0, from), to });
  const response = await fetch(url, { headers: { Accept: 'text/csv' }, credentials: 'same-origin' });
  if (!response.ok) throw await ApiProblem.from(response);
  saveBlob(await response.blob(), name);
}

/** Rows as CSV text: quoted where a cell needs it. */
export function csvText(columns: readonly string[], rows: readonly (readonly (string | number)[])[]): string {
  const cell = (value: string | number): string => {
    const text = String(value);
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return [columns, ...rows].map((row) => row.map(cell).join(',')).join('\n') + '\n';
}

/** All canvases inside `element`, at their places, under the panel's title, as PNG. */
export async function savePng(element: HTMLElement, title: string, name: string): Promise<void> {
  const box = element.getBoundingClientRect();
  const ratio = Math.max(2, devicePixelRatio || 1);
  const head = 26;
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(box.width * ratio);
  canvas.height = Math.round((box.height + head) * ratio);
  const context = canvas.getContext('2d');
  if (!context) return;
  const style = getComputedStyle(document.documentElement);
  context.scale(ratio, ratio);
  context.fillStyle = style.getPropertyValue('--surface');
  context.fillRect(0, 0, box.width, box.height + head);
  context.fillStyle = style.getPropertyValue('--ink');
  context.font = '600 13px Inter, sans-serif';
  context.fillText(title, 10, 18);
  for (const one of element.querySelectorAll('canvas')) {
    if (!one.width || !one.height) continue;
    const at = one.getBoundingClientRect();
    context.drawImage(one, at.left - box.left, at.top - box.top + head, at.width, at.height);
  }
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
  if (blob) saveBlob(blob, name);
}
