import { describe, expect, it } from 'vitest';
import type { RunDetail } from '../../api/types';
import type { AttackKind } from './hands/kinds';
import { placesOf, setByHand, typesAt, usualKind, usualType } from './attack_places';

const acting = (id: string, ...actsOn: AttackKind['actsOn']): AttackKind => ({ id, title: { en: id, zh: id }, actsOn, parameters: [] });
const known = [acting('bias', 'link', 'actuator', 'sensor'), acting('dos', 'link'), acting('dos_fdi', 'link'), acting('radar_fdi', 'sensor'), acting('replay', 'sensor'), acting('waveform', 'actuator')];
const types = ['bias', 'dos', 'dos_fdi', 'radar_fdi', 'replay', 'of_the_future'];
const run = (adversary: Record<string, unknown>): RunDetail => ({ document: { adversary } }) as unknown as RunDetail;
const both = { links: [{ id: '1-2', from: '1', to: '2', state: null }], nodes: [{ id: '1', position: null, state: 'sensor.1.state' }, { id: '2', position: null, state: null }] };
const tanks = { links: [], nodes: both.nodes };

describe('places of an attack by hand', () => {
  it('are the links and the sensors whose state the run tells', () => {
    expect(placesOf(both, 'link')).toEqual(['1-2']);
    expect(placesOf(both, 'sensor')).toEqual(['1']);
    expect(placesOf(null, 'sensor')).toEqual([]);
  });

  it('are actuators, too, where a subsystem has one: its own attacks are told first, a push by hand is a bias', () => {
    const areas = { links: [], nodes: [{ id: '1', position: null, state: 'sensor.1.state', actuator: true }, { id: '2', position: null, state: null, actuator: false }] };
    expect(placesOf(areas, 'actuator')).toEqual(['1']);
    expect(usualKind(run({ w1: { type: 'waveform', on: ['actuator:1'] } }), areas)).toBe('actuator');
    expect(usualKind(run({}), areas)).toBe('actuator');
    expect(usualKind({ ...run({}), family: 'replay' }, areas)).toBe('sensor');
    expect(usualKind(run({ r: { type: 'bias', on: ['sensor:1'] } }), areas)).toBe('sensor');
    expect(typesAt(['bias', 'dos', 'waveform'], 'actuator', known)).toEqual(['bias', 'waveform']);
    expect(usualType(run({ w1: { type: 'waveform', on: ['actuator:1'] } }), ['bias', 'waveform'], 'actuator')).toBe('bias');
  });

  it('take the attacks that act there, and those that nobody knows', () => {
    expect(typesAt(types, 'link', known)).toEqual(['bias', 'dos', 'dos_fdi', 'of_the_future']);
    expect(typesAt(types, 'sensor', known)).toEqual(['bias', 'radar_fdi', 'replay', 'of_the_future']);
  });

  it('ask for no schedule that the dialog asks for already', () => {
    expect(['case', 'record_from', 'record_to', 'start', 'end'].filter((name) => setByHand('replay', name))).toEqual(['record_from', 'record_to']);
    expect(setByHand('dos', 'start')).toBe(true);
  });

  it('begin with what the scenario itself attacks', () => {
    expect(usualKind(run({ a: { type: 'dos_fdi', on: ['link:*'] } }), both)).toBe('link');
    expect(usualKind(run({ a: { type: 'radar_fdi', on: ['sensor:1'] } }), both)).toBe('sensor');
    expect(usualKind(run({}), both)).toBe('link');
    expect(usualKind(run({}), tanks)).toBe('sensor');
    expect(usualKind(run({ a: { type: 'dos', on: ['link:*'] } }), tanks)).toBe('sensor');
    expect(usualType(run({ a: { type: 'radar_fdi', on: ['sensor:1'] } }), types, 'sensor')).toBe('radar_fdi');
    expect(usualType(run({}), types, 'sensor')).toBe('replay');
    expect(usualType(run({}), types, 'link')).toBe('dos_fdi');
    expect(usualType(run({}), ['dos'], 'link')).toBe('dos');
    expect(usualType(run({}), [], 'link')).toBe('');
  });
});
