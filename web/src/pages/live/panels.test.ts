import { render, screen, waitFor, within } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Mark, RunDetail, Signal } from '../../api/types';
import { Ring } from '../../data/ring';
import { Source } from '../../data/source';
import { language } from '../../i18n/i18n.svelte';
import Banner from './Banner.svelte';
import BoundPanel from './BoundPanel.svelte';
import { liveKey } from './context';
import EventsPanel from './EventsPanel.svelte';
import FeasiblePanel from './FeasiblePanel.svelte';
import Figures from './Figures.svelte';
import { makeModel } from './model';
import NotesDialog from './NotesDialog.svelte';
import RasterPanel from './RasterPanel.svelte';
import type { Session } from './session.svelte';
import SignalsPanel from './SignalsPanel.svelte';
import { LiveView } from './view.svelte';

const names = ['truth.x', 'truth.y', 'link.1-2.state', 'lane.a.1.error', 'lane.a.1.bound', 'lane.a.1.feasible28', 'lane.a.1.feasible29', 'lane.a.1.lost', 'lane.a.rmse', 'lane.b.rmse'];
const signals = names.map((name, id): Signal => {
  const parts = name.split('.');
  return { id, name, unit: 'cm', kind: 'scalar', lane: parts[0] === 'lane' ? parts[1] : null, node: parts[0] === 'lane' && parts.length > 3 ? parts[2] : null, link: parts[0] === 'link' ? '1-2' : null };
});

const run = {
  id: '7', scenario: 'consensus', family: 'consensus', title: { en: 'Eight cameras', zh: '八个摄像机' }, state: 'running', seed: 1, version: '0.1.0', pace: 20, tags: ['paper'], note: 'first',
  progress: { k: 9, steps: null, t: 9, dt: 1, ticks_per_second: 20 }, viewers: 1, faults: [], warnings: [], error: null, log: { gaps: 0 }, view: { plane: { components: ['x', 'y'] }, error_unit: 'cm' },
  metrics: [
    { lane: 'a', node: null, name: 'rmse_position', variant: null, value: 2.617 },
    { lane: 'a', node: null, name: 'bound_guaranteed', variant: null, value: false },
    { lane: 'a', node: null, name: 'first_infeasible_step', variant: null, value: 2 },
  ],
  world: { nodes: [{ id: '1', position: [0, 0] }, { id: '2', position: [1, 1] }], links: [{ id: '1-2', from: '1', to: '2' }, { id: '2-1', from: '2', to: '1' }], lanes: [{ id: 'a', method: 'm', adversary: true }, { id: 'b', method: 'm', adversary: false }], state: [] },
} as unknown as RunDetail;

function bench(change: { run?: Partial<RunDetail>; marks?: Mark[]; stream?: Session['stream'] } = {}): { session: Session; view: LiveView; context: Map<unknown, unknown> } {
  const source = new Source('7', signals, () => {}, () => new Promise(() => {}));
  const ring = new Ring(signals.map((signal) => signal.id));
  for (let k = 0; k < 10; k++) ring.push({ k, t: k, n: 1, v: Float64Array.from(signals, (_, i) => (i === 2 ? 1 : i + k / 10)) });
  source.rings = [ring];
  source.head = 9;
  const shown = { ...run, ...change.run };
  const session = {
    id: '7', run: shown, model: makeModel(shown, signals), source, live: true, stream: change.stream ?? { at: 'open' }, failure: null,
    status: { head: 9, t: 9, rate: 20, gaps: 0, drawMs: 1, stale: false }, marks: { all: change.marks ?? [], active: [] }, take: vi.fn(),
  } as unknown as Session;
  const view = new LiveView();
  view.head = 9;
  return { session, view, context: new Map([[liveKey, { session, view }]]) };
}

beforeEach(() => {
  history.replaceState(null, '', '/live/7');
  language.set('en');
});
afterEach(() => void vi.unstubAllGlobals());

describe('key figures', () => {
  it('show each lane at the newest tick with three digits, the run so far, and the verdict on the bound', async () => {
    const { context } = bench();
    render(Figures, { context });
    const lane = await screen.findByRole('button', { name: /^a / });
    await waitFor(() => expect(lane.textContent).toMatch(/8\.90\s*cm/));
    expect(lane.textContent).toContain('run 2.62');
    expect(screen.getByText('no')).toBeTruthy();
    expect(screen.getByText('infeasible from k = 2')).toBeTruthy();
    // Lane b has a live error, and no figure of the run: a dash, not 0.
    expect(screen.getByRole('button', { name: /^b / }).textContent).toContain('run –');
  });

  it('hide a lane on every panel, in the address too', async () => {
    const { context, view } = bench();
    render(Figures, { context });
    const lane = screen.getByRole('button', { name: /^a / });
    await userEvent.click(lane);
    expect(lane.getAttribute('aria-pressed')).toBe('false');
    expect(view.hidden).toEqual(['a']);
    expect(new URLSearchParams(location.search).get('hide')).toBe('a');
  });
});

describe('events', () => {
  it('are logged newest first, in the language of the page, and lead to their tick', async () => {
    const marks: Mark[] = [
      { k: 2, type: 'fault', edge: 'begin', lane: 'a', node: '1', code: 'infeasible_28', detail: 'lambda_max is 14' },
      { k: 5, type: 'attack', edge: 'begin', id: 'a1', code: 'dos' },
    ];
    const { context, view } = bench({ marks });
    render(EventsPanel, { context });
    const log = screen.getByRole('log');
    expect(within(log).getAllByRole('button').map((button) => button.textContent)).toEqual(['5', '2']);
    expect(log.textContent).toContain('lambda_max is 14');
    await userEvent.click(within(log).getByRole('button', { name: 'Show tick 2' }));
    expect(view.cursor).toBe(2);
    language.set('zh');
    await waitFor(() => expect(log.textContent).toContain('故障'));
  });
});

describe('the banner', () => {
  it('counts down to the next try', () => {
    const { context } = bench({ stream: { at: 'waiting', retryAt: Date.now() + 7500, tries: 3 } });
    render(Banner, { context });
    expect(screen.getByRole('status').textContent).toMatch(/Next try in [78] s/);
  });

  it('says of an interrupted run that it ended with its server, and offers the demo', async () => {
    vi.stubGlobal('fetch', async () => new Response(JSON.stringify({ demo: '12' }), { status: 200 }));
    const { context } = bench({ run: { state: 'interrupted' } });
    render(Banner, { context });
    expect(screen.getByRole('status').textContent).toContain('It ends at k = 9');
    expect((await screen.findByRole('link')).getAttribute('href')).toBe('/live/12');
  });
});

describe('panels', () => {
  it('say why they are empty', () => {
    const bare = bench({ run: { view: {}, world: { nodes: [], links: [], lanes: [{ id: 'b', method: 'm', adversary: false }], state: [] } } });
    bare.session.model = makeModel(bare.session.run!, signals.filter((signal) => signal.lane === 'b'));
    render(RasterPanel, { context: bare.context });
    render(FeasiblePanel, { context: bare.context });
    render(BoundPanel, { context: bare.context });
    expect(screen.getByText('This run has no links that can be attacked.')).toBeTruthy();
    expect(screen.getByText('No lane of this run has conditions (28), (29).')).toBeTruthy();
    expect(screen.getByText('Lane b publishes no bound.')).toBeTruthy();
  });

  it('give their data as a table', async () => {
    const { context } = bench();
    render(RasterPanel, { context });
    await userEvent.click(screen.getByRole('button', { name: /Data as a table/ }));
    const table = await screen.findByRole('table');
    await waitFor(() => expect(within(table).getAllByRole('row').length).toBe(11));
    expect(within(table).getAllByRole('row')[1]!.textContent).toMatch(/^9\s*D/);
  });

  it('draw any signal of the catalogue', async () => {
    const { context, view } = bench();
    render(SignalsPanel, { context });
    await userEvent.type(screen.getByRole('searchbox'), 'truth');
    await userEvent.click(await screen.findByRole('button', { name: /truth\.y/ }));
    expect(view.picked).toEqual(['truth.y']);
    expect(new URLSearchParams(location.search).get('signals')).toBe('truth.y');
  });
});

describe('tags and note', () => {
  it('are sent as the server wants them', async () => {
    const calls: { url: string; body: unknown }[] = [];
    vi.stubGlobal('fetch', async (url: string, init: RequestInit) => {
      calls.push({ url, body: JSON.parse(String(init.body)) });
      return new Response(JSON.stringify(run), { status: 200 });
    });
    const { context } = bench();
    render(NotesDialog, { context, props: { open: true } });
    const tags = await screen.findByLabelText(/Tags, separated/);
    await userEvent.clear(tags);
    await userEvent.type(tags, 'paper, long run');
    await userEvent.click(screen.getByRole('button', { name: 'Save' }));
    await waitFor(() => expect(calls).toEqual([{ url: '/api/v1/runs/7', body: { tags: ['paper', 'long run'], note: 'first' } }]));
  });
});
