import { render, screen, waitFor, within } from '@testing-library/svelte';
import userEvent from '@testing-library/user-event';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { JsonObject } from '../../../form/json';
import { at, put } from '../../../form/pointer';
import { documentIn, linkOf, longestLink } from '../../../form/share_link';
import { language } from '../../../i18n/i18n.svelte';
import SystemPage from '../SystemPage.svelte';
import TakeAlong from '../TakeAlong.svelte';
import { opened } from './open';
import type { Report } from './report';
import { start } from './starts';
import { withView } from './view';

const sight = { rank: 2, observable: true, detectable: true, hidden: [], weakest: null, verdict: 'node 1 sees every mode of the plant' };
const pole = { re: 1, im: 0, size: 1, behaviour: 'stays' as const, count: 2, text: '1' };
const report: Report = {
  scenario: 'own-system', tolerance: 'below 1e-9 counts as zero',
  plant: { kind: 'sampled', dt: 0.1, states: ['position', 'velocity'], inputs: ['force'], poles: [pole], continuous_poles: null, measure: 'modulus', largest: 1, stable: false, verdict: 'the pole 1 does not decay' },
  nodes: [{ id: '1', channels: ['y1'], ...sight }], joint: sight, control: null, controller: null,
  graph: { name: 'none', connected: true, components: [], verdict: 'one node' },
  methods: [
    { id: 'local_ekf', title: { en: 'Each node alone', zh: '各节点独立' }, fits: true, reason: null, pointer: null, needs_gains: false },
    { id: 'fusion', title: { en: 'Fusion', zh: '融合' }, fits: false, reason: 'it needs a fusion centre', pointer: '/network/graph', needs_gains: false },
  ],
  run: { starts: true, reason: null, pointer: null, warnings: [] },
};
const answer = (body: unknown, status = 200): Response => new Response(JSON.stringify(body), { status });

let asked: JsonObject[] = [];
let reply: () => Response;

beforeEach(() => {
  history.replaceState(null, '', '/system?kind=linear');
  language.set('en');
  asked = [];
  reply = () => answer(report);
  vi.stubGlobal('fetch', async (url: string, init: RequestInit) => {
    if (!url.endsWith('/systems/check')) return answer({ items: [], next: null });
    asked.push((JSON.parse(String(init.body)) as { scenario: JsonObject }).scenario);
    return reply();
  });
});
afterEach(() => void vi.unstubAllGlobals());

const page = (): unknown => render(SystemPage, { props: { params: {} } });
const cell = (name: string): HTMLInputElement => screen.getByRole('textbox', { name }) as HTMLInputElement;

describe('the form of a linear system', () => {
  it('is checked as one types, once a moment has passed, and not with a cell that is no number', async () => {
    page();
    await screen.findByText('It would start.');
    expect(asked).toHaveLength(1);
    await userEvent.type(cell('A, row 2, column 1'), '{Backspace}-4.5');
    await waitFor(() => expect(asked).toHaveLength(2));
    expect(at(asked[1], ['plant', 'params', 'A'])).toEqual([[0, 1], [-4.5, 0]]);
    await userEvent.type(cell('A, row 2, column 1'), 'x');
    await screen.findByText(/1 values are no numbers yet/);
    expect((screen.getByRole('button', { name: 'Run it' }) as HTMLButtonElement).disabled).toBe(true);
    await userEvent.type(cell('A, row 2, column 1'), '{Backspace}1');
    await waitFor(() => expect(at(asked.at(-1), ['plant', 'params', 'A'])).toEqual([[0, 1], [-4.51, 0]]));
    expect(asked.flatMap((one) => at(one, ['plant', 'params', 'A']) as unknown[]).flat().every((one) => typeof one === 'number')).toBe(true);
  });

  it('puts a refusal to the matrix it names', async () => {
    reply = () => answer({ title: 'Invalid', status: 422, detail: '', errors: [{ pointer: '/scenario/nodes/1/sensor/params/R', detail: 'R is not positive semidefinite.' }] }, 422);
    page();
    const place = await waitFor(() => {
      const found = document.getElementById('f/nodes/1/sensor/params/R')!;
      expect(found.textContent).toContain('R is not positive semidefinite.');
      return found;
    });
    expect(within(place).getByRole('textbox').getAttribute('aria-invalid')).toBe('true');
    expect((screen.getByRole('button', { name: 'Run it' }) as HTMLButtonElement).disabled).toBe(true);
  });

  it('offers the methods that fit and says why the others do not', async () => {
    page();
    expect((await screen.findByRole('checkbox', { name: /^local_ekf/ }) as HTMLInputElement).checked).toBe(true);
    expect((screen.getByRole('checkbox', { name: /^fusion/, hidden: true }) as HTMLInputElement).disabled).toBe(true);
    expect(screen.getByText('not here: it needs a fusion centre')).toBeTruthy();
    await userEvent.click(screen.getByRole('button', { name: 'Add a lane of local_ekf spared by attacks' }));
    await waitFor(() => expect(at(asked.at(-1), ['lanes', 'local_ekf_clean'])).toEqual({ method: 'local_ekf', adversary: false }));
  });

  it('has its document in the address, and comes back from it', async () => {
    page();
    await userEvent.type(cell('A, row 1, column 1'), '{Backspace}7');
    await waitFor(async () => expect(at(await documentIn(location.hash), ['plant', 'params', 'A'])).toEqual([[7, 1], [0, 0]]));
  });

  it('loses nothing on the way to the other kind and back', async () => {
    page();
    await userEvent.type(cell('A, row 1, column 1'), '{Backspace}7');
    await userEvent.click(screen.getByRole('radio', { name: 'Interconnected subsystems' }));
    await screen.findByRole('textbox', { name: 'A of subsystem 1, row 1, column 1' });
    await userEvent.click(screen.getByRole('radio', { name: 'Linear plant with sensors' }));
    await waitFor(() => expect(cell('A, row 1, column 1').value).toBe('7'));
  });

  it('opens a link of either kind, and says it where one cannot be read', async () => {
    const chain = put(opened(start('chain'))!, ['time', 'dt'], 0.25);
    const document = withView(chain, chain);
    history.replaceState(null, '', new URL(await linkOf('/system', document)).href);
    const first = render(SystemPage, { props: { params: {} } });
    await waitFor(() => expect(asked.at(-1)).toEqual(document));
    expect(new URLSearchParams(location.search).get('kind')).toBe('linear');
    first.unmount();
    history.replaceState(null, '', '/system#doc=abc');
    page();
    await screen.findByText(/cannot be read/);
  });

  it('shares no link that programs would break, and says so', async () => {
    const noise = Array.from(crypto.getRandomValues(new Uint8Array(40_000)), (byte) => byte.toString(36)).join('');
    render(TakeAlong, { props: { path: '/system', document: { id: 'a', view: { noise } }, ready: true, saved: null, presets: new Set<string>(), taken: new Set<string>(), onopen: () => undefined, onsaved: () => undefined } });
    await userEvent.click(screen.getByRole('button', { name: 'Copy a link' }));
    await screen.findByText(new RegExp(`beyond ${longestLink.toLocaleString('en')} many programs break it`));
  });
});
