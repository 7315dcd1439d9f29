import { expect, test } from 'vitest';
import { chosen, readInput } from './input';

const fields = { kind: 'ingest', trace: '', deadline: '0.5', further: '', name: '', clock: 'k' } as const;

test('a run’s input is said as the server takes it', () => {
  expect(readInput(null).body).toBe('simulate');
  expect(readInput('7').body).toEqual({ trace: '7' });
  expect(readInput('7;').body).toBe('simulate');
  expect(chosen(fields).body).toEqual({ ingest: { deadline: 0.5 } });
  expect(chosen({ ...fields, further: 'lane.mine.1.estimate.x, sensor.1.state' }).body).toEqual({ ingest: { deadline: 0.5, columns: ['lane.mine.1.estimate.x', 'sensor.1.state'] } });
});

test('a name on the broker is one level of a topic, and says whose clock counts', () => {
  expect(chosen({ ...fields, name: ' line1 ', clock: 'arrival' }).body).toEqual({ ingest: { deadline: 0.5, mqtt: { name: 'line1', clock: 'arrival' } } });
  for (const bad of ['a/b', 'a b', '+', '#', 'x'.repeat(201)]) expect(chosen({ ...fields, name: bad }).fault).toBe('name');
  expect(chosen({ ...fields, name: 'pump-7' }).fault).toBe('');
  expect(chosen({ ...fields, kind: 'simulate', name: 'a/b' }).fault).toBe('');
});

test('a deadline is a time the server takes', () => {
  for (const good of ['0.001', '3600', '1', '.5', '1e-2']) expect(chosen({ ...fields, deadline: good }).fault).toBe('');
  for (const bad of ['', '0', '4000', '-1', 'x', '1 s', 'Infinity']) expect(chosen({ ...fields, deadline: bad }).fault).toBe('deadline');
  expect(chosen({ ...fields, kind: 'simulate', deadline: '' }).fault).toBe('');
});
