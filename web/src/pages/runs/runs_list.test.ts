import { beforeEach, describe, expect, it, vi } from 'vitest';
import { api } from '../../api/client';
import type { Page, RunDetail, RunItem, RunState } from '../../api/types';
import { RunsList } from './runs_list.svelte';

vi.mock('../../api/client', () => ({ api: { runs: vi.fn(), run: vi.fn() } }));

/** The list reads no more of a run than this. */
const run = (id: string, state: RunState): RunDetail => ({ id, state, progress: { k: 0, t: 0, ticks_per_second: null } }) as unknown as RunDetail;
const page = (...items: RunItem[]): Page<RunItem> => ({ items, next: null });
const states = (list: RunsList): string[] => list.items.map((item) => `${item.id} ${item.state}`);

/** An answer of the server that comes when the test says so. */
function answer<T>(): { promise: Promise<T>; give: (value: T) => void } {
  let give!: (value: T) => void;
  const promise = new Promise<T>((resolve) => (give = resolve));
  return { promise, give };
}

describe('a list that is told what happens', () => {
  beforeEach(() => vi.resetAllMocks());

  it('forgets nothing that it hears while a page is on its way', async () => {
    const list = new RunsList();
    const first = answer<Page<RunItem>>();
    vi.mocked(api.runs).mockReturnValueOnce(first.promise);
    vi.mocked(api.run).mockResolvedValueOnce(run('7', 'finished'));
    const loaded = list.load('', '');
    const told = list.heard({ id: '7', state: 'finished' });
    first.give(page(run('7', 'running')));
    await loaded;
    await told;
    expect(states(list)).toEqual(['7 finished']);
  });

  it('hears one thing after the other, however the answers come', async () => {
    const list = new RunsList();
    vi.mocked(api.runs).mockResolvedValueOnce(page(run('7', 'queued')));
    await list.load('', '');
    const slow = answer<RunDetail>();
    vi.mocked(api.run).mockReturnValueOnce(slow.promise).mockResolvedValueOnce(run('7', 'finished'));
    void list.heard({ id: '7', state: 'running' });
    const told = list.heard({ id: '7', state: 'finished' });
    slow.give(run('7', 'running'));
    await told;
    expect(states(list)).toEqual(['7 finished']);
  });

  it('prefers a later page to an earlier answer', async () => {
    const list = new RunsList();
    vi.mocked(api.runs).mockResolvedValueOnce(page(run('7', 'queued'))).mockResolvedValueOnce(page(run('7', 'finished')));
    await list.load('', '');
    const slow = answer<RunDetail>();
    vi.mocked(api.run).mockReturnValueOnce(slow.promise);
    const told = list.heard({ id: '7', state: 'running' });
    await vi.waitFor(() => expect(api.run).toHaveBeenCalled());
    await list.reload();
    slow.give(run('7', 'running'));
    await told;
    expect(states(list)).toEqual(['7 finished']);
  });

  it('shows a run it did not know before the others', async () => {
    const list = new RunsList();
    vi.mocked(api.runs).mockResolvedValueOnce(page(run('6', 'finished'))).mockResolvedValueOnce(page(run('7', 'running'), run('6', 'finished')));
    await list.load('', '');
    await list.heard({ id: '7', state: 'running' });
    expect(states(list)).toEqual(['7 running', '6 finished']);
  });
});
