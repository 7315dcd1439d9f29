import { render, screen, waitFor, within } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { language } from '../../i18n/i18n.svelte';
import { refusalsAt, wrongPlaces } from './check';
import { couplingPointer, documentOf, draftOf, matrixPointer, signalPointer } from './document';
import { addCoupling, emptySubsystem, removeCoupling, setCount, setMatrix, setSizes, setSubsystem } from './draft';
import { start } from './starts';
import SystemPage from './SystemPage.svelte';

type Doc = { plant: { params: { subsystems: Record<string, Record<string, unknown>>; couplings: Record<string, unknown> } }; nodes: Record<string, { signals?: Record<string, unknown> }>; adversary: Record<string, { on: string[] }>; initial: { truth: number[] }; time: { steps: number } };
const doc = (system: Parameters<typeof documentOf>[0]): Doc => documentOf(system) as unknown as Doc;

describe('a description', () => {
  it('grows and shrinks: what was there stays, the rest is zero', () => {
    let system = setSizes(start('empty'), 0, { n: 3, g: 1 });
    expect(system.subsystems[0]!.matrices.A).toEqual([[0, 0, 0], [0, 0, 0], [0, 0, 0]]);
    expect(system.subsystems[0]!.matrices.G).toEqual([[0], [0]]);
    system = setMatrix(system, 0, 'C', [[1, 2, 3, 4], [5, 6, 7, 8], [9, 9, 9, 9]]);
    expect(system.subsystems[0]!.sizes).toMatchObject({ n: 4, p: 3, g: 1 });
    expect(system.subsystems[0]!.matrices.A).toHaveLength(4);
    expect(system.subsystems[0]!.matrices.G).toHaveLength(3);
    expect(system.subsystems[0]!.x0).toEqual([0, 0, 0, 0]);
    expect(setMatrix(system, 0, 'A', [[1, 2, 3, 4, 5]]).subsystems[0]!.matrices.A.map((row) => row.length)).toEqual([5, 5, 5, 5, 5]);
  });

  it('couples one way or both, and forgets what joins a subsystem that is gone', () => {
    let system = addCoupling(setCount(start('empty'), 3), 0, 2, true);
    system = addCoupling(system, 1, 0, false);
    expect(system.couplings.map(({ from, to }) => [from, to])).toEqual([[0, 2], [2, 0], [1, 0]]);
    expect(addCoupling(system, 0, 2, true).couplings).toHaveLength(3);
    expect(setSizes(system, 2, { n: 5 }).couplings[0]!.H).toHaveLength(5);
    expect(setCount(system, 2).couplings.map(({ from, to }) => [from, to])).toEqual([[1, 0]]);
    expect(removeCoupling(system, 1, 0).couplings).toHaveLength(2);
    expect(setCount(system, 99).subsystems).toHaveLength(8);
  });

  it('becomes a document without what it does not have, and comes back from it', () => {
    for (const name of ['empty', 'pair', 'undetectable'] as const) expect(draftOf(documentOf(start(name)))).toEqual(start(name));
    const pair = doc(start('pair'));
    expect(Object.keys(pair.plant.params.subsystems)).toEqual(['1', '2']);
    expect(pair.plant.params.couplings).toMatchObject({ '2-1': [[-0.05, 0, 0], [0, 0, -0.1], [0, 0, 0], [0, 0, 0]] });
    expect(pair.initial.truth).toEqual([0.03358, 0.005, 0, 0, -0.0626, 0, 0]);
    expect(pair.time.steps).toBe(20000);
    expect(Object.values(pair.adversary).map(({ on }) => on)).toEqual([['actuator:1.w1'], ['actuator:2.w1']]);
    expect(Object.keys(pair.nodes['1']!.signals!)).toEqual(['d1', 'f1']);
    const empty = doc(start('empty'));
    expect(Object.keys(empty.plant.params.subsystems['1']!)).toEqual(['A', 'C', 'D', 'alpha', 'tau', 'phi']);
    expect(empty.adversary).toEqual({});
  });

  it('is not read from a scenario of another plant', () => {
    expect(draftOf({ plant: { type: 'pair', params: {} } })).toBeNull();
  });

  it('names what is no number by the place it has in the document', () => {
    let system = setSubsystem(start('pair'), 1, { x0: [0, 'a', 0] });
    system = setMatrix(system, 0, 'D', [[1], ['x'], [1], [0]]);
    expect(wrongPlaces(system)).toEqual(['/plant/params/subsystems/1/D', '/plant/params/subsystems/2/x0']);
    expect(wrongPlaces({ ...start('pair'), dt: '' })).toEqual(['/time/dt']);
    expect(wrongPlaces(start('pair'))).toEqual([]);
  });

  it('finds the refusals of a place', () => {
    const refusals = [{ pointer: matrixPointer(0, 'D'), detail: 'a' }, { pointer: `${matrixPointer(0, 'D')}/1/0`, detail: 'b' }, { pointer: matrixPointer(0, 'Dd'), detail: 'c' }];
    expect(refusalsAt(refusals, matrixPointer(0, 'D'))).toEqual(['a', 'b']);
    expect(couplingPointer({ from: 1, to: 0 })).toBe('/plant/params/couplings/2-1');
    expect([signalPointer(0, 'd', 0), signalPointer(1, 'w', 0)]).toEqual(['/nodes/1/signals/d1', '/adversary/w2_1']);
    expect(emptySubsystem({ q: 2 }).signals.w).toHaveLength(2);
  });
});

describe('the page', () => {
  const answer = (body: unknown, status = 200): Response => new Response(JSON.stringify(body), { status });
  let calls: { url: string; body: unknown }[] = [];
  let reply: (url: string) => Response;

  beforeEach(() => {
    history.replaceState(null, '', '/system?start=undetectable');
    language.set('en');
    calls = [];
    vi.stubGlobal('fetch', async (url: string, init: RequestInit) => {
      if (init.body) calls.push({ url, body: JSON.parse(String(init.body)) });
      return url.startsWith('/api/v1/scenarios') ? answer({ items: [], next: null }) : reply(url);
    });
  });
  afterEach(() => void vi.unstubAllGlobals());

  const cell = (name: string): HTMLInputElement => screen.getByRole('textbox', { name }) as HTMLInputElement;
  const synthesise = (): Promise<void> => userEvent.click(screen.getByRole('button', { name: 'Synthesise' }));

  it('takes a pasted matrix and lets the subsystem grow with it', async () => {
    render(SystemPage, { props: { params: {} } });
    cell('A of subsystem 1, row 1, column 1').focus();
    await userEvent.paste('-1\t0\t0\n0\t-2\t0\n0\t0\t-3');
    await waitFor(() => expect(cell('A of subsystem 1, row 3, column 3').value).toBe('-3'));
    expect(cell('C of subsystem 1, row 1, column 3').value).toBe('0');
    expect((screen.getByRole('spinbutton', { name: /^n/ }) as HTMLInputElement).value).toBe('3');
  });

  it('puts a refusal to the matrix it names, until something is changed', async () => {
    reply = () => answer({ title: 'Invalid', status: 422, detail: '', errors: [{ pointer: '/scenario/plant/params/subsystems/1/D', detail: 'D of subsystem 1 lacks column rank.' }] }, 422);
    render(SystemPage, { props: { params: {} } });
    await synthesise();
    const place = await waitFor(() => {
      const found = document.getElementById('f/plant/params/subsystems/1/D')!;
      expect(found.textContent).toContain('lacks column rank');
      return found;
    });
    expect(within(place).getAllByRole('textbox')[0]!.getAttribute('aria-invalid')).toBe('true');
    expect(calls[0]!.url).toBe('/api/v1/designs');
    await userEvent.type(cell('D of subsystem 1, row 2, column 1'), '5');
    await waitFor(() => expect(place.textContent).not.toContain('lacks column rank'));
  });

  it('waits for the gains, says why there are none, and offers no run then', async () => {
    const item = { lane: 'intermediate_ref', key: 'abc', seconds: 0.2, limit: 30, record: null };
    let asked = 0;
    reply = (url) => (url.endsWith('/designs') ? answer({ items: [{ ...item, state: 'solving' }] }, 202) : answer({ ...item, state: asked++ ? 'refused' : 'solving', reason: 'not observable: invariant zero' }));
    render(SystemPage, { props: { params: {} } });
    await synthesise();
    expect((await screen.findByRole('alert')).textContent).toContain('No certified gains for intermediate ref: not observable: invariant zero');
    expect((screen.getByRole('button', { name: 'Run it' }) as HTMLButtonElement).disabled).toBe(true);
  });

  it('offers the run when every lane has its certificate, and no longer when the description has changed', async () => {
    reply = () => answer({ items: [{ lane: 'intermediate_ref', key: 'abc', state: 'done', seconds: 0.2, limit: 30, record: { key: 'abc', holds: true, solver: 'DSDP', poles: [[-1, 0]], norm_l: [12] } }] }, 202);
    render(SystemPage, { props: { params: {} } });
    const run = screen.getByRole('button', { name: 'Run it' }) as HTMLButtonElement;
    expect(run.disabled).toBe(true);
    await synthesise();
    await waitFor(() => expect(run.disabled).toBe(false));
    expect(screen.getByText(/The certificate holds/)).toBeTruthy();
    await userEvent.type(cell('A of subsystem 1, row 1, column 2'), '1');
    await waitFor(() => expect(run.disabled).toBe(true));
  });

  it('leads to a cell that is no number instead of asking', async () => {
    render(SystemPage, { props: { params: {} } });
    await userEvent.type(cell('A of subsystem 1, row 1, column 1'), 'x');
    await synthesise();
    expect(calls).toEqual([]);
    await screen.findByText('1 values are no numbers yet.');
  });
});
