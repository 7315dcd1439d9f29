import { base } from '../api/client';
import { ApiProblem } from '../api/problem';

/**
 * Sends a text as it is. A bundle must not pass through the page's numbers: a 64-bit seed would not come out as it went in.
 * Throws ApiProblem.
 */
export async function sendText<T>(path: string, text: string, type: string): Promise<T> {
  let response: Response;
  try {
    response = await fetch(base + path, { method: 'POST', credentials: 'same-origin', headers: { 'Content-Type': type }, body: text });
  } catch (error) {
    throw new ApiProblem(0, 'No answer from the server', error instanceof Error ? error.message : '');
  }
  if (!response.ok) throw await ApiProblem.from(response);
  return (await response.json()) as T;
}

/** Gives the reader a file that the page made. */
export function download(name: string, text: string, type: string): void {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const anchor = document.createElement('a');
  anchor.href = url;
  anchor.download = name;
  anchor.click();
  URL.revokeObjectURL(url);
}

/** Puts a text on the clipboard, also where the page came over plain HTTP and the browser hides its clipboard. */
export async function copyText(text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = document.createElement('textarea');
    area.value = text;
    area.className = 'hidden-text';
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
}
