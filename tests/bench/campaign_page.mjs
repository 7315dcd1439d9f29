// How smooth a campaign's page is with 200 points and 10 000 trials, measured in a headless browser at a server that runs: prints the tasks over 50 ms by what was done meanwhile, and what was read.
// node tests/bench/campaign_page.mjs URL [THREADS]
import { openBrowser } from '../e2e/support/browser.mjs';

const [url, threads = '2'] = process.argv.slice(2);
const call = async (method, path, body) => {
  const response = await fetch(`${url}/api/v1${path}`, { method, headers: { 'Content-Type': 'application/json' }, body: body && JSON.stringify(body) });
  return response.status === 204 ? null : response.json();
};
const grid = { 'adversary.links.params.pdos': Array.from({ length: 20 }, (_, i) => i / 25), 'lanes.consensus.params.tau': Array.from({ length: 10 }, (_, i) => 0.005 + i / 1000) };
const { id } = await call('POST', '/campaigns', { scenario: 'consensus', patch: { time: { steps: 60 } }, runs: 50, threads: Number(threads), sweep: grid });
const look = () => call('GET', `/campaigns/${id}?results=false`);

const browser = await openBrowser();
const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
page.setDefaultTimeout(120_000);
const read = {};
page.on('requestfinished', async (request) => {
  const place = new URL(request.url());
  if (!place.pathname.startsWith('/api/v1/campaigns/')) return;
  const one = (read[place.pathname.replace(/\d+/g, 'N').replace('/api/v1', '')] ??= { calls: 0, bytes: 0, slowest: 0 });
  one.calls++;
  one.slowest = Math.max(one.slowest, request.timing().responseEnd);
  one.bytes += (await request.sizes().catch(() => ({ responseBodySize: 0 }))).responseBodySize;
});
await page.addInitScript(() => {
  window.tasks = [];
  window.phase = 'opening';
  new PerformanceObserver((list) => list.getEntries().forEach((entry) => window.tasks.push([window.phase, entry.duration]))).observe({ type: 'longtask', buffered: true });
});
const phase = (name) => page.evaluate((now) => (window.phase = now), name);
const plot = (name) => page.getByRole('img', { name });

/** Moves the pointer all over a figure, a step a frame. */
async function over(name) {
  const place = plot(name);
  if ((await place.count()) === 0) return;
  await place.scrollIntoViewIfNeeded();
  const box = await place.boundingBox();
  for (let i = 0; i <= 60; i++) {
    await page.mouse.move(box.x + 10 + ((box.width - 20) * i) / 60, box.y + 20 + ((box.height - 40) * ((i * 7) % 60)) / 60);
    await page.waitForTimeout(16);
  }
}

async function brush() {
  const box = await plot(/10,000 trials over/).boundingBox();
  const axis = box.x + 14 + 0.4 * (box.width - 28);
  await page.mouse.move(axis, box.y + 60);
  await page.mouse.down();
  for (let i = 0; i < 60; i++) {
    await page.mouse.move(axis, box.y + 60 + 3 * i);
    await page.waitForTimeout(16);
  }
  await page.mouse.up();
  await page.waitForTimeout(1000);
}

let begin = performance.now();
await page.goto(`${url}/campaigns/${id}?metric=rmse_position&lang=en`);
await page.getByRole('region', { name: /^Results/ }).waitFor();
console.log(`results are shown after ${Math.round(performance.now() - begin)} ms`);
await phase('it runs, the pointer moves');
let rounds = 0;
while (rounds < 8 && (await look()).state === 'running') {
  for (const name of [/^rmse_position over/, /^rmse_position of/, /trials of consensus.rmse_position/]) await over(name);
  rounds++;
}
console.log(`the pointer went ${rounds} times over three figures while it ran`);
await phase('waiting for the last trial');
while ((await look()).state === 'running') await page.waitForTimeout(1000);
await phase('reading 10 000 trials');
begin = performance.now();
await page.getByRole('button', { name: 'Read the trials' }).click();
await plot(/10,000 trials over/).waitFor();
console.log(`10 000 trials are read after ${Math.round(performance.now() - begin)} ms`);
await page.waitForTimeout(2000);
await phase('parallel coordinates, the pointer moves');
await over(/10,000 trials over/);
await phase('brushing');
await brush();
await phase('another point');
await page.getByRole('button', { name: 'Point 3', exact: true }).click();
await page.waitForTimeout(1500);
await phase('another metric');
await page.getByLabel('Metric').selectOption('rmse_heading');
await page.waitForTimeout(2000);

const byPhase = new Map();
for (const [name, duration] of await page.evaluate(() => window.tasks)) byPhase.set(name, [...(byPhase.get(name) ?? []), Math.round(duration)]);
console.log('tasks over 50 ms:');
for (const [name, all] of byPhase) console.log(`  ${name}: ${all.length}, the longest ${Math.max(...all)} ms, over 100 ms: ${all.filter((one) => one > 100).length}`);
console.log('read:');
for (const [path, one] of Object.entries(read)) console.log(`  ${path}: ${one.calls} calls, ${Math.round(one.bytes / one.calls)} bytes each, the slowest ${Math.round(one.slowest)} ms`);
await browser.close();
await call('DELETE', `/campaigns/${id}`, {});
