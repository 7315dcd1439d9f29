import { describe, expect, test } from 'vitest';
import type { Compatibility, Row } from '../../api/compatibility';
import { linesOf } from './compatibility';

const row = (attack: string, reason: string | null, cells: Row['cells']): Row => ({ attack, title: { en: attack, zh: attack }, channel: 'sensor', place: 'sensor:1', params: {}, reason, cells });
const table: Compatibility = {
  lanes: [
    { id: 'a', method: 'm' },
    { id: 'b', method: 'm' },
  ],
  rows: [
    row('bias', null, { a: { meets: 'estimate', reason: null }, b: { meets: null, reason: 'spared' } }),
    row('waveform', 'it does not act on sensors', {}),
    row('dos', null, { a: { meets: null, reason: 'deaf' }, b: { meets: null, reason: 'spared' } }),
  ],
};

describe('the lines of the table', () => {
  test('leave out what acts nowhere, unless it is asked for', () => {
    expect(linesOf(table, false).lines.map(({ row: { attack } }) => attack)).toEqual(['bias', 'dos']);
    expect(linesOf(table, true).lines).toHaveLength(3);
  });

  test('have a word or the number of a reason in every cell, and no reason twice', () => {
    const { lines, reasons } = linesOf(table, true);
    expect(reasons).toEqual(['spared', 'it does not act on sensors', 'deaf']);
    expect(lines[0]!.marks).toEqual([
      { meets: 'estimate', reason: 0 },
      { meets: null, reason: 1 },
    ]);
    expect(lines[1]!.marks.map(({ reason }) => reason)).toEqual([2, 2]);
    expect(lines[2]!.marks.map(({ reason }) => reason)).toEqual([3, 1]);
  });
});
