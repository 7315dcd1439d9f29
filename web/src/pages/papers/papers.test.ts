import { describe, expect, test } from 'vitest';
import type { FigurePanel, PaperItem, PanelSeries, Verdict } from '../../api/papers';
import { readPatch } from '../../form/share';
import { bySource, countOf, isFew, kindOf, neighbours, readKind } from './items';
import { frameOf, pathOf, placesOf, rowsOf, signOf, size, stemsOf } from './plot';
import { formOf, keyOf, orderOf } from './scenes';
import { bandText, commandOf, paperText, pieces, withError } from './text';

function item(key: string, verdict: Verdict | null): PaperItem {
  return { key, title: { en: key, zh: key }, spec: '', scenario: '', rule: '', reason: '', paper: null, ours: null, se: null, verdict, runs: null, seed: null, version: null, ended: null, zh: { paper: null, reason: '', rule: '' }, scenes: [], methods: [] };
}
const items = [item('000/fig1', 'reproduced'), item('000/fig2', null), item('001/fig2', 'not reproduced'), item('003/fig1', 'reproduced after correction')];

function series(style: PanelSeries['style'], x: (number | null)[], y: (number | null)[]): PanelSeries {
  return { name: style, style, x, y };
}
function panel(all: PanelSeries[], yScale: 'linear' | 'log' = 'linear'): FigurePanel {
  return { title: 'p', x: { label: 'k', scale: 'linear' }, y: { label: 'error, m', scale: yScale }, series: all, zh: { title: '图', x: 'k', y: '误差', names: all.map((one) => one.name) } };
}

describe('items', () => {
  test('are grouped by source, and by verdict where asked', () => {
    expect(bySource(items, null).map((source) => [source.source, source.items.length])).toEqual([['000', 2], ['001', 1], ['003', 1]]);
    expect(bySource(items, 'corrected').map((source) => source.source)).toEqual(['003']);
    expect(countOf(items, 'none')).toBe(1);
    expect(items.map(kindOf)).toEqual(['reproduced', 'none', 'not', 'corrected']);
    expect(readKind('not')).toBe('not');
    expect(readKind('toString')).toBeNull();
    expect([null, 1, 2, 29, 30].map(isFew)).toEqual([false, false, true, true, false]);
  });

  test('know what stands before and after', () => {
    expect(neighbours(items, '001/fig2')).toEqual({ previous: items[1], next: items[3] });
    expect(neighbours(items, '000/fig1').previous).toBeNull();
    expect(neighbours(items, '003/fig1').next).toBeNull();
    expect(neighbours(items, 'nosuch')).toEqual({ previous: null, next: null });
  });
});

describe('a panel', () => {
  test('breaks a line where a value is missing or has no place', () => {
    const line = series('line', [0, 1, 2, 3, 4], [1, 10, null, 100, 0]);
    const drawn = panel([line], 'log');
    const frame = frameOf(drawn);
    expect(placesOf(line, frame).map((at) => at !== null)).toEqual([true, true, false, true, false]);
    expect(pathOf(line, frame).match(/[ML]/g)).toEqual(['M', 'L', 'M']);
    expect([frame.x.lo, frame.x.hi]).toEqual([0, 4]);
    expect(frame.y.lo).toBeLessThan(1);
    expect(frame.y.hi).toBeGreaterThan(100);
  });

  test('keeps every point inside', () => {
    const points = series('points', [-3, 0.5, 7], [2, -4, 9]);
    for (const at of placesOf(points, frameOf(panel([points])))) {
      expect(at!.x).toBeGreaterThanOrEqual(size.left);
      expect(at!.x).toBeLessThanOrEqual(size.width - size.right);
      expect(at!.y).toBeGreaterThanOrEqual(size.top);
      expect(at!.y).toBeLessThanOrEqual(size.height - size.bottom);
    }
  });

  test('draws steps at right angles and stems from zero', () => {
    const steps = series('steps', [0, 1], [0, 1]);
    expect(pathOf(steps, frameOf(panel([steps])))).toMatch(/^M[\d.]+ [\d.]+H[\d.]+V[\d.]+$/);
    const stems = series('stems', [0, 1], [2, 4]);
    const frame = frameOf(panel([stems]));
    expect(frame.y.lo).toBe(0);
    expect(stemsOf(stems, frame).match(new RegExp(`M[\\d.]+ ${size.height - size.bottom}V`, 'g'))).toHaveLength(2);
  });

  test('has a frame without a value', () => {
    const nothing = series('line', [null], [null]);
    for (const scale of ['linear', 'log'] as const) {
      const frame = frameOf(panel([nothing], scale));
      expect(frame.y.hi).toBeGreaterThan(frame.y.lo);
      expect(pathOf(nothing, frame)).toBe('');
    }
  });

  test('tells its series apart without colour', () => {
    const signs = Array.from({ length: 9 }, (_, i) => signOf(series('line', [], []), i));
    expect(new Set(signs.map((sign) => `${sign.token} ${sign.dash}`)).size).toBe(9);
    expect(new Set(signs.slice(0, 8).map((sign) => sign.dash)).size).toBe(8);
    expect(signOf(series('dashed', [], []), 0).dash).not.toBe('');
    expect(signOf({ ...series('line', [], []), name: 'truth' }, 3)).toMatchObject({ token: 'ink', dash: '' });
    expect(signOf(series('edge', [], []), 0).token).toBe('control');
  });

  test('gives its data as rows', () => {
    expect(rowsOf(panel([series('line', [0, 1], [5, null])]))).toEqual({ columns: ['series', 'k', 'error, m'], rows: [['line', 0, 5], ['line', 1, '']] });
  });
});

describe('the run of a figure', () => {
  const place = { key: '000/fig2', scenes: [{ name: { en: 'wide', zh: '宽' }, scenario: 'consensus', patch: { lanes: { clean: null }, network: { graph: 'ring' } } }] };

  test('is asked for with the figure’s own patch, and as the same one each time', () => {
    expect(orderOf(place, 0, 7)).toEqual({ scenario: 'consensus', patch: place.scenes[0]!.patch, seed: 7, pace: 'max', tags: ['papers', '000/fig2'], note: '000/fig2: wide' });
    expect(keyOf('000/fig2', 0, 7, '1.0')).toMatch(/^[\x20-\x7e]{1,255}$/);
    expect(keyOf('000/fig2', 0, 7, '1.0')).not.toBe(keyOf('000/fig2', 0, 8, '1.0'));
  });

  test('has a form with the same changes', () => {
    const form = new URL(formOf(place, 0, 7), 'http://here');
    expect(form.pathname).toBe('/scenarios/consensus');
    expect(form.searchParams.get('seed')).toBe('7');
    expect(readPatch(form.searchParams.get('patch'))).toEqual(place.scenes[0]!.patch);
  });
});

describe('texts', () => {
  test('with names in them', () => {
    expect(pieces('the guard `clip` is one, `a` too')).toEqual(['the guard ', 'clip', ' is one, ', 'a', ' too']);
    expect(pieces('an odd ` sign')).toEqual(['an odd ` sign']);
  });

  test('of numbers with their errors; rounding is none', () => {
    expect(withError({ ours: 2.5, se: 0.25 })).toBe('2.50\u00a0± 0.25');
    expect(withError({ ours: 0.9933, se: 8.9e-17 })).toBe('0.993\u00a0± 0');
    expect(withError({ ours: 0.9933, se: null })).toBe('0.993');
    expect(withError({ ours: null, se: null })).toBe('–');
  });

  test('of bands and numbers', () => {
    expect(bandText({ low: 1, high: 2 })).toBe('1.000 to 2.000');
    expect(bandText({ low: 1.5, high: 1e12 })).toBe('≥ 1.500');
    expect(bandText({ low: null, high: 3 })).toBe('≤ 3.000');
    expect(bandText({ low: null, high: null })).toBe('any');
    expect(paperText(0.30000000000000004)).toBe('0.3');
    expect(paperText('falls')).toBe('falls');
    expect(paperText(null)).toBe('–');
    expect(commandOf('003/fig5', 200, 1)).toBe('vigil papers --only 003/fig5 --runs 200 --seed 1');
  });
});
