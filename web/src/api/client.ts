/// Calls to the server's API. Every failure is an ApiProblem.
import { ApiProblem } from './problem';
import type { Mark, NewAttack, NewRun, Page, RunDetail, RunItem, Samples, ScenarioItem, ServerInfo, Signal } from './types';

export const base = '/api/v1';

type Query = Record<string, string | number | null | undefined>;

export function address(path: string, query: Query = {}): string {
  const search = new URLSearchParams();
  for (const [key, value] of Object.entries(query)) if (value !== null && value !== undefined && value !== '') search.set(key, String(value));
  const text = search.toString();
  return `${base}${path}${text ? `?${text}` : ''}`;
}

/** Told of every 401, so that the shell can ask for the token. */
let onUnauthorised: () => void = () => {};
export function whenUnauthorised(callback: () => void): void {
  onUnauthorised = callback;
}

async function send(method: string, url: string, init: RequestInit = {}): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(url, { method, credentials: 'same-origin', ...init });
  } catch (error) {
    if (error instanceof DOMException && error.name === 'AbortError') throw error;
    throw new ApiProblem(0, 'No answer from the server', error instanceof Error ? error.message : '');
  }
  if (response.status === 401) onUnauthorised();
  if (!response.ok) throw await ApiProblem.from(response);
  return response;
}

async function body<T>(response: Response): Promise<T> {
  if (response.status === 204) return undefined as T;
  const text = await response.text();
  return (text ? JSON.parse(text) : undefined) as T;
}

export async function get<T>(path: string, query?: Query, signal?: AbortSignal): Promise<T> {
  return body<T>(await send('GET', address(path, query), { signal, headers: { Accept: 'application/json' } }));
}

/** A text as it is, e.g. a trace's CSV or a bundle: no number of it passes through the page's. */
export async function textOf(path: string, type: string, query?: Query): Promise<string> {
  return (await send('GET', address(path, query), { headers: { Accept: type } })).text();
}

async function write<T>(method: string, path: string, json: unknown, headers: Record<string, string> = {}): Promise<T> {
  return body<T>(await send(method, address(path), { headers: { 'Content-Type': 'application/json', ...headers }, body: JSON.stringify(json) }));
}

export const post = <T>(path: string, json: unknown, headers?: Record<string, string>): Promise<T> => write<T>('POST', path, json, headers);
export const put = <T>(path: string, json: unknown): Promise<T> => write<T>('PUT', path, json);
export const patch = <T>(path: string, json: unknown): Promise<T> => write<T>('PATCH', path, json);
export const remove = <T = void>(path: string): Promise<T> => write<T>('DELETE', path, {});

/** Sends a CSV text, e.g. a trace. */
export async function postCsv<T>(path: string, text: string, query?: Query): Promise<T> {
  return body<T>(await send('POST', address(path, query), { headers: { 'Content-Type': 'text/csv' }, body: text }));
}

async function beginSession(token: string): Promise<void> {
  // What no header can carry cannot be the token either.
  const sent = /^[\x21-\x7e]+$/.test(token.trim()) ? token.trim() : 'invalid';
  await send('POST', address('/session'), { headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${sent}` } });
}

/** A key nobody else has. crypto.randomUUID is missing where the page came over plain HTTP. */
export function freshKey(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, '0')).join('');
}

function runPath(id: string, rest = ''): string {
  return `/runs/${encodeURIComponent(id)}${rest}`;
}

export const api = {
  server: (signal?: AbortSignal) => get<ServerInfo>('/server', {}, signal),
  /** Trades the token for a cookie that scripts cannot read. */
  session: (token: string) => beginSession(token),

  scenarios: (signal?: AbortSignal) => get<Page<ScenarioItem>>('/scenarios', {}, signal),
  scenario: (id: string, signal?: AbortSignal) => get<Record<string, unknown>>(`/scenarios/${encodeURIComponent(id)}`, {}, signal),
  schema: (id: string, signal?: AbortSignal) => get<Record<string, unknown>>(`/scenarios/${encodeURIComponent(id)}/schema`, {}, signal),
  methods: (signal?: AbortSignal) => get<unknown>('/methods', {}, signal),

  runs: (query: { q?: string; sort?: string; limit?: number; cursor?: string } = {}, signal?: AbortSignal) => get<Page<RunItem>>('/runs', query, signal),
  run: (id: string, signal?: AbortSignal) => get<RunDetail>(runPath(id), {}, signal),
  /** Starts a run. The same key sent again starts no second one. */
  start: (run: NewRun, key: string = freshKey()) => post<RunDetail>('/runs', run, { 'Idempotency-Key': key }),
  change: (id: string, changes: Record<string, unknown>) => patch<RunDetail>(runPath(id), changes),
  deleteRun: (id: string) => remove(runPath(id)),
  fork: (id: string, k: number, changes: Record<string, unknown> = {}) => post<RunDetail>(runPath(id, '/fork'), { k, patch: changes }),
  attack: (id: string, attack: NewAttack) => post<{ id: string; k: number }>(runPath(id, '/attacks'), attack),
  endAttack: (id: string, attack: string) => remove(runPath(id, `/attacks/${encodeURIComponent(attack)}`)),

  signals: async (id: string, signal?: AbortSignal): Promise<Signal[]> => {
    const answer = await get<Page<Signal> | Signal[]>(runPath(id, '/signals'), {}, signal);
    return Array.isArray(answer) ? answer : answer.items;
  },
  samples: (id: string, query: { signals: string; from?: number; to?: number; points?: number }, signal?: AbortSignal) =>
    get<Samples>(runPath(id, '/samples'), query, signal),
  samplesAddress: (id: string, query: { signals: string; from?: number; to?: number; points?: number }) => address(runPath(id, '/samples'), query),
  marks: (id: string, query: { from?: number; to?: number; type?: string; limit?: number; cursor?: string } = {}, signal?: AbortSignal) => get<Page<Mark>>(runPath(id, '/marks'), query, signal),
};
