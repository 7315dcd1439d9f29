// Serves dist and a made-up API of the same shape as the real one, to look at the page without building the server.
// node mock/server.mjs [port]
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { metrics, row, signals, world } from './model.mjs';

const port = Number(process.argv[2] ?? 8090);
const dist = fileURLToPath(new URL('../dist/', import.meta.url));
const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml', '.woff2': 'font/woff2' };
const policy = "default-src 'self'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; object-src 'none'; base-uri 'none'; frame-ancestors 'none'";

const runs = new Map();
function makeRun(id, extra) {
  const run = { id, state: 'running', pace: 20, k0: 0, at: Date.now(), steps: null, tags: [], note: '', marks: [], attacks: 0, listeners: new Set(), created: new Date().toISOString(), ...extra };
  runs.set(id, run);
  return run;
}
const head = (run) => (run.state === 'running' ? Math.min(run.steps ?? Infinity, run.k0 + Math.floor(((Date.now() - run.at) / 1000) * run.pace)) : run.k0);
const hold = (run) => {
  run.k0 = head(run);
  run.at = Date.now();
};
const demo = makeRun('1', { k0: 4000, note: 'demo' });
makeRun('2', { state: 'finished', k0: 30, steps: 30 });
makeRun('3', { k0: 100, pace: 5, tags: ['paper'] });
for (const run of runs.values()) {
  run.marks.push({ k: 1, type: 'attack', edge: 'begin', id: 'links', code: 'dos_fdi', detail: 'dos_fdi on every link' });
  run.marks.push({ k: 2, type: 'fault', edge: 'begin', lane: 'consensus', node: '1', code: 'infeasible_28', detail: 'lambda_max 14.2 is above 7.69' });
}

function view(run, whole) {
  const k = head(run);
  const base = {
    id: run.id, scenario: 'consensus', family: 'consensus', title: { en: 'Consensus filter under DoS + FDI', zh: 'DoS 与 FDI 混合攻击下的共识滤波' },
    state: run.state, seed: 7, version: '0.1.0', pace: run.pace, input: 'simulate', tags: run.tags, note: run.note, created: run.created, started: run.created,
    ended: run.state === 'finished' ? run.created : null, progress: { k, steps: run.steps, t: k, dt: 1, ticks_per_second: run.state === 'running' ? run.pace : 0 },
    epoch: 'mock', parent: run.parent ?? null, viewers: run.listeners.size, metrics: metrics(k), faults: [], warnings: [],
    view: { plane: { components: ['x', 'y'], heading: 'theta', unit: 'cm' }, lane: 'consensus', error_unit: 'cm' }, error: null, reproducible: true, log: { gaps: 0 },
  };
  return whole ? { ...base, design: {}, commands: [], document: { vigil: 1, id: 'consensus', lanes: { consensus: { method: 'consensus_ekf', params: { tau: 0.01 } } }, adversary: { links: { type: 'dos_fdi', on: ['link:*'], from: 1, to: null, params: { pdos: 0.2, pfdi: 0.2 } } } }, world } : base;
}

function samples(run, query) {
  const names = (query.get('signals') ?? '').split(',');
  const from = Math.max(0, Number(query.get('from') ?? 0));
  const to = Math.min(head(run), Number(query.get('to') ?? head(run)));
  const points = Number(query.get('points') ?? 1000);
  const picked = names.map((name) => signals.find((signal) => signal.name === name || String(signal.id) === name));
  const columns = picked.map((signal) => signal?.id);
  const bucket = Math.max(1, Math.ceil((to - from + 1) / points));
  const k = [];
  const series = picked.map(({ name: signal }) => (bucket === 1 ? { signal, v: [] } : { signal, lo: [], hi: [] }));
  for (let start = from; start <= to; start += bucket) {
    k.push(start);
    const rows = [];
    for (let j = start; j < Math.min(start + bucket, to + 1); j++) rows.push(row(j));
    series.forEach((one, i) => {
      const values = rows.map((r) => r[columns[i]] ?? null).filter((v) => v !== null);
      if (one.v) one.v.push(values[0] ?? null);
      else {
        one.lo.push(values.length ? Math.min(...values) : null);
        one.hi.push(values.length ? Math.max(...values) : null);
      }
    });
  }
  return { k, bucket, series };
}

function topicSignals(topic) {
  if (topic === 'overview') return signals.filter((s) => !s.lane || !s.node || s.name.endsWith('.error')).map((s) => s.id);
  if (topic.startsWith('lane:')) return signals.filter((s) => s.lane === topic.slice(5) || s.name.startsWith('truth.')).map((s) => s.id);
  return signals.map((s) => s.id);
}

function stream(run, query, request, response) {
  if (run.state === 'finished') return response.writeHead(204).end();
  response.writeHead(200, { 'Content-Type': 'text/event-stream', 'Cache-Control': 'no-store' });
  const ids = topicSignals(query.get('topic') ?? 'overview');
  const send = (event, data, id) => response.write(`${id ? `id: ${id}\n` : ''}event: ${event}\ndata: ${JSON.stringify(data)}\n\n`);
  const last = (request.headers['last-event-id'] ?? query.get('lastEventId') ?? '').split('.');
  const resumed = last[0] === 'mock';
  let next = resumed ? Math.max(Number(last[1]) + 1, head(run) - 500) : head(run);
  response.write('retry: 1000\n');
  send('hello', { epoch: 'mock', run: run.id, topic: query.get('topic') ?? 'overview', resumed, from: next, head: head(run), dt: 1, signals: ids });
  const listener = { mark: (mark) => send('mark', mark) };
  run.listeners.add(listener);
  const timer = setInterval(() => {
    for (; next <= head(run); next++) {
      const values = row(next);
      send('frame', { k: next, t: next, n: 1, v: ids.map((id) => values[id]) }, `mock.${next}`);
    }
  }, 25);
  const ping = setInterval(() => send('ping', { head: head(run) }), 10000);
  request.on('close', () => {
    clearInterval(timer);
    clearInterval(ping);
    run.listeners.delete(listener);
  });
}

function mark(run, body) {
  const made = { k: head(run) + 1, edge: null, ...body };
  run.marks.push(made);
  for (const listener of run.listeners) listener.mark(made);
}

function change(run, body) {
  hold(run);
  for (const key of ['state', 'pace', 'tags', 'note']) if (key in body) run[key] = body[key];
  if (body.step) run.k0 += Number(body.step);
  if (body.state) mark(run, { type: 'state', code: body.state });
  if (body.params) mark(run, { type: 'command', detail: JSON.stringify(body.params) });
  return view(run, true);
}

async function body(request) {
  let text = '';
  for await (const piece of request) text += piece;
  return text ? JSON.parse(text) : {};
}

const json = (response, status, value, headers = {}) => response.writeHead(status, { 'Content-Type': 'application/json', ...headers }).end(JSON.stringify(value));
const problem = (response, status, title) => response.writeHead(status, { 'Content-Type': 'application/problem+json' }).end(JSON.stringify({ type: 'about:blank', title, status, detail: title, errors: [] }));

async function runRoute(request, response, url, parts) {
  const run = runs.get(parts[1]);
  if (!run) return problem(response, 404, 'There is no such run');
  const rest = parts[2];
  if (!rest && request.method === 'GET') return json(response, 200, view(run, true));
  if (!rest && request.method === 'PATCH') return json(response, 200, change(run, await body(request)));
  if (rest === 'signals') return json(response, 200, { items: signals, next: null });
  if (rest === 'samples') return json(response, 200, samples(run, url.searchParams));
  if (rest === 'marks') return json(response, 200, { items: run.marks, next: null });
  if (rest === 'stream') return stream(run, url.searchParams, request, response);
  if (rest === 'attacks' && request.method === 'POST') {
    const asked = await body(request);
    const id = `a${++run.attacks}`;
    mark(run, { type: 'attack', edge: 'begin', id, code: asked.type, link: asked.on[0]?.replace('link:', ''), detail: `${asked.type} on ${asked.on.join(', ')}` });
    return json(response, 201, { id, k: head(run) + 1 });
  }
  if (rest === 'attacks' && request.method === 'DELETE') {
    mark(run, { type: 'attack', edge: 'end', id: parts[3] });
    return response.writeHead(204).end();
  }
  if (rest === 'fork') {
    const asked = await body(request);
    const made = makeRun(String(runs.size + 1), { k0: asked.k, parent: { run: run.id, k: asked.k } });
    return json(response, 201, view(made, true));
  }
  return problem(response, 404, 'There is no such route');
}

async function apiRoute(request, response, url) {
  const parts = url.pathname.slice('/api/v1/'.length).split('/').map(decodeURIComponent);
  if (parts[0] === 'server') return json(response, 200, { version: '0.1.0', uptime: 12, runs: { running: 2, queued: 0, max: 8 }, viewers: demo.listeners.size, log: { bytes: 12_400_000, queue: 0, state: 'ok' }, demo: '1', auth: false });
  if (parts[0] === 'scenarios' && !parts[1]) return json(response, 200, { items: ['consensus', 'consensus-compass', 'consensus-literal', 'mrclam'].map((id) => ({ id, family: 'consensus', title: { en: id, zh: id }, source: 'seed 000' })), next: null });
  if (parts[0] === 'scenarios') return json(response, 200, {});
  if (parts[0] === 'methods') return json(response, 200, { attacks: [] });
  if (parts[0] === 'runs' && !parts[1]) {
    if (request.method === 'POST') return json(response, 201, view(makeRun(String(runs.size + 1), { k0: 0 }), true));
    return json(response, 200, { items: [...runs.values()].reverse().map((run) => view(run, false)), next: null });
  }
  if (parts[0] === 'runs') return runRoute(request, response, url, parts);
  return problem(response, 404, 'There is no such route');
}

createServer(async (request, response) => {
  const url = new URL(request.url, 'http://localhost');
  try {
    if (url.pathname.startsWith('/api/v1/')) return await apiRoute(request, response, url);
    const file = join(dist, normalize(url.pathname));
    const found = extname(url.pathname) ? file : join(dist, 'index.html');
    const content = await readFile(found);
    response.writeHead(200, { 'Content-Type': types[extname(found)] ?? 'application/octet-stream', 'Content-Security-Policy': policy }).end(content);
  } catch {
    problem(response, 404, 'There is no such file');
  }
}).listen(port, '127.0.0.1', () => console.log(`mock listening on http://127.0.0.1:${port}`));
