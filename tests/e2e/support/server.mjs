// Starts the real server on a free port with a log of its own, and ends it.
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../../../', import.meta.url));
export const dist = process.env.VIGIL_WEB ?? join(root, 'web', 'dist');
export const binary = process.env.VIGIL_BINARY ?? join(root, 'build', 'release', 'vigil');
export const deadline = 60_000;

export function folder() {
  const path = mkdtempSync(join(tmpdir(), 'vigil-e2e-'));
  return { path, remove: () => rmSync(path, { recursive: true, force: true }) };
}

function firstLine(child, output) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error(`the server did not say where it listens:\n${output.text}`)), deadline);
    createInterface({ input: child.stdout }).on('line', (line) => {
      output.text += `${line}\n`;
      const found = /listening on (http:\/\/\S+)/.exec(line);
      if (!found) return;
      clearTimeout(timer);
      resolve(found[1]);
    });
    child.once('error', reject);
    child.once('exit', (code, signal) => reject(new Error(`the server ended (${code ?? signal}) before it listened:\n${output.text}`)));
  });
}

/** Starts `vigil serve`. `db` and `port` serve to start one again on the same file and port. */
export async function startServer({ db, port = 0, options = [] } = {}) {
  if (!existsSync(binary)) throw new Error(`${binary} is not built`);
  const own = db ? null : folder();
  const file = db ?? join(own.path, 'vigil.db');
  const child = spawn(binary, ['serve', '--port', String(port), '--db', file, '--web', dist, ...options], { stdio: ['ignore', 'pipe', 'pipe'] });
  const output = { text: '' };
  child.stderr.on('data', (data) => (output.text += data));
  const url = await firstLine(child, output);
  const ended = new Promise((resolve) => child.once('exit', resolve));
  const end = async (signal) => {
    if (child.exitCode === null && child.signalCode === null) child.kill(signal);
    await ended;
  };
  return {
    url,
    port: Number(new URL(url).port),
    db: file,
    output,
    kill: () => end('SIGKILL'),
    stop: async () => {
      await end('SIGTERM');
      own?.remove();
    },
  };
}

/** Calls the API from outside the browser; throws on any answer that is not 2xx. */
export async function call(server, method, path, body) {
  const response = await fetch(`${server.url}/api/v1${path}`, {
    method,
    headers: body === undefined ? {} : { 'Content-Type': 'application/json' },
    body: body === undefined ? undefined : JSON.stringify(body),
  });
  const text = await response.text();
  if (!response.ok) throw new Error(`${method} ${path}: ${response.status} ${text}`);
  return text ? JSON.parse(text) : undefined;
}

/** Waits until `holds` answers something true, asking again and again; says what it saw last when the time is over. */
export async function until(what, holds, limit = deadline) {
  const end = Date.now() + limit;
  let last;
  while (Date.now() < end) {
    last = await holds();
    if (last) return last;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error(`never came true: ${what} (last: ${JSON.stringify(last)})`);
}

export async function runUntil(server, id, state) {
  return until(`run ${id} is ${state}`, async () => {
    const run = await call(server, 'GET', `/runs/${id}`);
    return run.state === state ? run : null;
  });
}

/** Starts a run as fast as it goes and answers it when it has finished. */
export async function finishedRun(server, body) {
  const { id } = await call(server, 'POST', '/runs', { pace: 'max', ...body });
  return runUntil(server, id, 'finished');
}
