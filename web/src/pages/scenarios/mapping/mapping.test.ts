import { describe, expect, test } from 'vitest';
import { edits, guess, stepOf } from './guess';
import { countSignals, fromJson, label, lacking, laneSignals, nothing, time, toJson, twice, type ScenarioColumns } from './mapping';

const scenario: ScenarioColumns = {
  columns: ['sensor.1.p', 'sensor.1.q', 'sensor.2.p', 'sensor.2.q', 'input.u1', 'truth.x', 'truth.y', 'truth.theta'],
  nodes: ['1', '2'],
  lanes: ['consensus'],
  dt: 1,
  mapping: null,
};

describe('a guess by names', () => {
  test('equal names, names with other signs, and what people call them', () => {
    const roles = guess(['sensor.1.p', 'SENSOR_1_Q', 'p2', 'Node 2: q', 'u1', 'x', 'true y', 'Time', 'k', 'mood'], scenario.columns);
    expect([...roles.values()]).toEqual(['sensor.1.p', 'sensor.1.q', 'sensor.2.p', 'sensor.2.q', 'input.u1', 'truth.x', 'truth.y', time, nothing, nothing]);
  });

  test('near names, but never another digit', () => {
    expect(guess(['truth.tetha'], scenario.columns).get('truth.tetha')).toBe('truth.theta');
    expect(guess(['sensor.3.p'], scenario.columns).get('sensor.3.p')).toBe(nothing);
    expect(guess(['z'], scenario.columns).get('z')).toBe(nothing);
  });

  test('a signal is given once, to the nearest name', () => {
    const roles = guess(['x', 'truth.x'], scenario.columns);
    expect(roles.get('truth.x')).toBe('truth.x');
    expect(roles.get('x')).toBe(nothing);
  });

  test('estimates computed elsewhere', () => {
    expect(guess(['xhat_2'], laneSignals(scenario, 'mine')).get('xhat_2')).toBe('lane.mine.2.estimate.x');
    expect(laneSignals(scenario, 'mine')).toHaveLength(6);
  });

  test('edits and steps', () => {
    expect(edits('theta', 'tetha')).toBe(2);
    expect(edits('', 'ab')).toBe(2);
    expect(stepOf(['0.1', '0.4'])).toBe(0.3);
    expect(stepOf(['monday', 'tuesday'])).toBeNull();
    expect(stepOf(['1', ''])).toBeNull();
    expect(stepOf(['2', '1'])).toBeNull();
  });
});

describe('the mapping as JSON', () => {
  const roles = new Map([['A', 'sensor.1.p'], ['B', 'sensor.2.q'], ['when', time], ['flag', label], ['mood', nothing]]);
  const json = { dt: 0.5, columns: { 'sensor.1.p': 'A', 'sensor.2.q': 'B' }, label: { column: 'flag', nodes: ['1', '2'] } };

  test('has what the command line takes and nothing else', () => {
    expect(toJson({ roles, dt: 0.5, lag: 0, constants: {}, labelled: null })).toEqual(json);
    expect(toJson({ roles: new Map([['A', 'input.u1']]), dt: 1, lag: 1, constants: { 'input.u2': 3 }, labelled: null })).toEqual({ dt: 1, columns: { 'input.u1': 'A' }, constants: { 'input.u2': 3 }, input_lag: 1 });
  });

  test('comes back as it went', () => {
    const back = fromJson(json, ['A', 'B', 'when', 'flag', 'mood'], 1)!;
    expect(back.roles.get('when')).toBe(nothing);
    expect(toJson(back)).toEqual(json);
  });

  test('is none without columns; what the table lacks is named', () => {
    expect(fromJson({ dt: 1 }, ['A'], 1)).toBeNull();
    expect(fromJson([], ['A'], 1)).toBeNull();
    expect(lacking(json, ['A', 'mood'])).toEqual(['B', 'flag']);
    expect(fromJson({ columns: { x: 'Z' }, dt: -1 }, ['A'], 2)).toEqual({ roles: new Map([['A', nothing]]), dt: 2, lag: 0, constants: {}, labelled: null });
  });

  test('a signal of two columns is found', () => {
    expect(twice(new Map([['a', 'truth.x'], ['b', 'truth.x'], ['c', nothing], ['d', nothing]]))).toEqual(['truth.x']);
    expect(countSignals(roles)).toBe(2);
  });
});
