import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { RunItem } from '../../api/types';
import { changedParameters } from './changed';
import { cell, runsCsv } from './csv';
import { pendingDelete } from './pending_delete';
import { columnOf, cutAt, narrowed, quoted } from './query';
import { appended, ariaSort, durationOf, errorsByLane, nextSort, readSort, replaced, windowOf, writeSort } from './table';

function run(id: string, more: Partial<RunItem> = {}): RunItem {
  return {
    id, scenario: 'consensus', family: 'consensus', title: { en: 'Consensus', zh: '共识' }, state: 'finished', seed: 1, version: '0.1.0',
    pace: 'max', input: 'simulate', tags: [], note: '', created: '2026-03-01T12:00:00.000Z', started: '2026-03-01T12:00:01.000Z',
    ended: '2026-03-01T12:00:03.500Z', progress: { k: 30, steps: 30, t: 30, dt: 1, ticks_per_second: null }, epoch: 'e', parent: null,
    viewers: 0, metrics: [], faults: [], warnings: [], view: {}, error: null, reproducible: true, log: { gaps: 0 }, ...more,
  };
}

describe('query box', () => {
  it('quotes what is more than a word', () => {
    expect(quoted('paper')).toBe('paper');
    expect(quoted('two words')).toBe('"two words"');
    expect(quoted('a"b\\')).toBe('"a\\"b\\\\"');
    expect(quoted('OR')).toBe('"OR"');
    expect(quoted('2..3')).toBe('"2..3"');
    expect(quoted('共识')).toBe('共识');
  });

  it('narrows a query without changing what it meant', () => {
    expect(narrowed('', 'seed:1')).toBe('seed:1');
    expect(narrowed('state:running', 'seed:1')).toBe('state:running AND seed:1');
    expect(narrowed('seed:1 OR seed:2', 'state:failed')).toBe('(seed:1 OR seed:2) AND state:failed');
    expect(narrowed('note:"this OR that"', 'seed:1')).toBe('note:"this OR that" AND seed:1');
  });

  it('finds the column the server names and points at it', () => {
    expect(columnOf(['no place', 'column 7: expected a value'])).toBe(7);
    expect(columnOf(['nothing'])).toBeUndefined();
    expect(cutAt('seed:>', 6)).toEqual({ before: 'seed:', at: '>', after: '' });
    expect(cutAt('seed:', 99)).toEqual({ before: 'seed:', at: ' ', after: '' });
    expect(cutAt('𝛼b', 2)).toEqual({ before: '𝛼', at: 'b', after: '' });
  });
});

describe('sorting', () => {
  it('goes falling, rising, newest first', () => {
    const first = nextSort(readSort(null), 'seed');
    expect(writeSort(first)).toBe('-seed');
    const second = nextSort(first, 'seed');
    expect(writeSort(second)).toBe('seed');
    expect(ariaSort(second, 'seed')).toBe('ascending');
    expect(ariaSort(second, 'state')).toBeUndefined();
    expect(writeSort(nextSort(second, 'seed'))).toBe('');
    expect(readSort('-consensus.rmse_position')).toEqual({ field: 'consensus.rmse_position', falling: true });
  });
});

describe('windowed rows', () => {
  it('always adds up to the whole height and holds what is seen', () => {
    for (const [count, top] of [[0, 0], [5, 0], [1000, 0], [1000, 16_000], [1000, 99_999], [3, 500]] as const) {
      const view = windowOf(count, 32, top, 600);
      expect(view.above + (view.end - view.first) * 32 + view.below).toBe(count * 32);
      expect(view.first).toBeLessThanOrEqual(view.end);
    }
    const view = windowOf(1000, 32, 3200, 640);
    expect(view.first).toBeLessThanOrEqual(100);
    expect(view.end).toBeGreaterThanOrEqual(120);
    expect(view.end - view.first).toBeLessThan(60);
  });
});

describe('rows', () => {
  it('takes each lane its network figure', () => {
    const metrics = [
      { lane: 'consensus', node: '1', name: 'rmse_position', variant: null, value: 9 },
      { lane: 'consensus', node: null, name: 'rmse_heading', variant: null, value: 3 },
      { lane: 'consensus', node: null, name: 'rmse_position', variant: null, value: 2.6 },
      { lane: 'clean', node: null, name: 'theorem2_holds', variant: null, value: false },
      { lane: 'clean', node: null, name: 'rmse_position', variant: null, value: null },
    ];
    expect(errorsByLane(run('1', { metrics }))).toEqual([
      { lane: 'consensus', name: 'rmse_position', value: 2.6 },
      { lane: 'clean', name: 'rmse_position', value: null },
    ]);
  });

  it('knows how long a run took or has been going', () => {
    expect(durationOf(run('1'), 0)).toBe(2.5);
    expect(durationOf(run('1', { ended: null }), Date.parse('2026-03-01T12:00:11.000Z'))).toBe(10);
    expect(durationOf(run('1', { started: null }), 0)).toBeNull();
  });

  it('replaces and appends without doubles', () => {
    const items = [run('3'), run('2')];
    expect(replaced(items, run('2', { state: 'failed' })).map((item) => item.state)).toEqual(['finished', 'failed']);
    expect(appended(items, [run('2'), run('1')]).map((item) => item.id)).toEqual(['3', '2', '1']);
  });

  it('shows only what differs from the scenario', () => {
    const preset = { id: 'consensus', title: { en: 'A' }, time: { steps: 30 }, lanes: { consensus: { params: { tau: 0.01 } } } };
    const changed = { id: 'mine', title: { en: 'B' }, time: { steps: 30 }, lanes: { consensus: { params: { tau: 0.02 } } } };
    expect(changedParameters(preset, changed)).toEqual([
      { path: 'lanes.consensus.params.tau', short: 'consensus.tau', from: '0.01', to: '0.02' },
    ]);
    expect(changedParameters(preset, preset)).toEqual([]);
  });
});

describe('list as CSV', () => {
  it('quotes cells and disarms formulas', () => {
    expect(cell('a,"b"')).toBe('"a,""b"""');
    expect(cell('=1+1')).toBe("'=1+1");
    expect(cell(-2.5)).toBe('-2.5');
    expect(cell(null)).toBe('');
  });

  it('has one row a run and one column a figure', () => {
    const metrics = [{ lane: 'consensus', node: null, name: 'rmse_position', variant: null, value: 2.651 }];
    const text = runsCsv([run('2', { metrics, tags: ['a', 'b'] }), run('1', { note: 'x\ny' })], () => 'tau=1', 0);
    const lines = text.split('\r\n');
    expect(lines[0]).toContain('consensus.rmse_position');
    expect(lines[1]).toContain(',a b,');
    expect(lines[1]!.endsWith(',2.651')).toBe(true);
    expect(lines[2]).toContain('"x\ny"');
    expect(lines).toHaveLength(4);
  });
});

describe('deleting with undo', () => {
  beforeEach(() => vi.useFakeTimers());
  afterEach(() => vi.useRealTimers());

  it('waits, can be taken back, and erases once', () => {
    const erased: string[] = [];
    const pending = pendingDelete((id) => erased.push(id), () => {}, 10_000);
    pending.add(['1', '2']);
    vi.advanceTimersByTime(9_000);
    pending.undo();
    vi.advanceTimersByTime(20_000);
    expect(erased).toEqual([]);
    pending.add(['3']);
    expect(pending.ids.has('3')).toBe(true);
    vi.advanceTimersByTime(10_000);
    expect(erased).toEqual(['3']);
    pending.add(['4']);
    pending.flush();
    vi.advanceTimersByTime(10_000);
    expect(erased).toEqual(['3', '4']);
  });
});
