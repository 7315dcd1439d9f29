import { describe, expect, test } from 'vitest';
import { ApiProblem } from '../../../api/problem';
import { pieces, push, Unfit, type Tally } from './push';

const columns = ['sensor.1.p', 'truth.x'];
const table = 'k,t,"truth.x",mood, sensor.1.p \n0,0,1,good,\n1,1,2,"so, so",3\n2,2,,bad,4\n';

describe('pieces of a table', () => {
  test('have the columns that the run takes, in the table’s order, and no others', () => {
    expect([...pieces(table, columns, 2)]).toEqual([
      { csv: 'k,truth.x,sensor.1.p\n0,1,\n1,2,3\n', rows: 2 },
      { csv: 'k,truth.x,sensor.1.p\n2,,4\n', rows: 1 },
    ]);
    expect([...pieces('k,truth.x\n', columns)]).toEqual([]);
  });

  test('are refused by name where the table does not fit', () => {
    const why = (text: string): Unfit | undefined => {
      try {
        return void [...pieces(text, columns)];
      } catch (error) {
        return error as Unfit;
      }
    };
    expect(why('')).toBeInstanceOf(Unfit);
    expect(why('')?.why).toBe('k');
    expect(why('t,truth.x\n0,1\n')?.why).toBe('k');
    expect(why('k,mood\n0,1\n')?.why).toBe('columns');
    expect(why('k,truth.x\n0,1\n1\n')).toMatchObject({ why: 'ragged', line: 3 });
    expect(why('k,truth.x\n0,1\n')).toBeUndefined();
  });
});

describe('pushing', () => {
  const tally = (accepted: number): Tally => ({ accepted, duplicate: 1, late: 0, beyond: 0 });
  const abort = new AbortController();

  test('sends the same again where the run is behind, after the time it asks for', async () => {
    const sent: string[] = [];
    const waited: number[] = [];
    const told: boolean[] = [];
    const answer = await push({
      run: '7',
      text: table,
      columns,
      signal: abort.signal,
      told: ({ behind }) => told.push(behind),
      wait: async (seconds) => void waited.push(seconds),
      post: async (path, csv) => {
        sent.push(`${path} ${csv.length}`);
        if (sent.length === 1) throw new ApiProblem(429, 'Too Many Requests', '', [], null, 3);
        if (sent.length === 2) throw new ApiProblem(429, 'Too Many Requests', '');
        return tally(3);
      },
    });
    expect(sent).toHaveLength(3);
    expect(new Set(sent).size).toBe(1);
    expect(waited).toEqual([3, 1]);
    expect(told).toEqual([true, true, false]);
    expect(answer).toEqual({ sent: 3, total: { accepted: 3, duplicate: 1, late: 0, beyond: 0 }, behind: false });
  });

  test('ends with any other refusal, and where it is told to', async () => {
    const refusing = push({ run: '7', text: table, columns, signal: abort.signal, told: () => {}, post: async () => Promise.reject(new ApiProblem(409, 'Conflict', 'over')) });
    await expect(refusing).rejects.toMatchObject({ status: 409 });
    const ended = new AbortController();
    ended.abort();
    const answer = await push({ run: '7', text: table, columns, signal: ended.signal, told: () => {}, post: async () => tally(1) });
    expect(answer.sent).toBe(0);
  });
});
