import { describe, expect, it } from 'vitest';
import type { Mark } from '../../../api/types';
import { noticesOf, reachedNodes } from './delays';
import { dragged, gripAt, proposalFor } from './drag';
import { beginsAtOnce, fittingParams, judgedByDocument, kindsOf, resized } from './kinds';
import { between, distance, hit, nodePlaces, receiverHalf, type Target } from './layout';
import { pictureOf, pictureTargets } from './network';
import { barRows, covers, placeText, plannedEnd, spansOf, type AttackSpan } from './spans';
import { always, sentTimes } from './times';
import { offersAt } from './verbs';

const attack = (k: number, edge: 'begin' | 'end', id: string): Mark => ({ k, type: 'attack', edge, id, code: 'dos' });
const alarm = (k: number, edge: 'begin' | 'end', lane = 'a', node = '1'): Mark => ({ k, type: 'alarm', edge, lane, node, code: 'detection' });

describe('places under a hand', () => {
  it('stand where the nodes stand, or round a circle', () => {
    expect(nodePlaces([{ position: [0, 0] }, { position: [10, 20] }], 200, 100, 20)).toEqual([{ x: 85, y: 80 }, { x: 115, y: 20 }]);
    const round = nodePlaces([{ position: null }, { position: null }, { position: null }, { position: null }], 100, 100, 10);
    expect(round.map(({ x, y }) => [Math.round(x), Math.round(y)])).toEqual([[50, 10], [90, 50], [50, 90], [10, 50]]);
    expect(nodePlaces([{ position: [3, 4] }], 80, 60)).toEqual([{ x: 40, y: 30 }]);
    expect(nodePlaces([{ position: [3, 4] }, { position: [3, 4] }], 80, 60, 10).map(({ y }) => Math.round(y))).toEqual([10, 50]);
  });

  it('give each direction of a link the half at its receiver', () => {
    const [a, b] = [{ x: 0, y: 0 }, { x: 100, y: 0 }];
    expect(receiverHalf(a, b, 10)).toEqual({ a: { x: 50, y: 0 }, b: { x: 90, y: 0 } });
    expect(between(a, b, 10)).toEqual({ a: { x: 10, y: 0 }, b: { x: 90, y: 0 } });
    expect(receiverHalf(a, a, 10)).toEqual({ a, b: a });
  });

  it('are hit within reach, a node before the links at it, of links the nearest', () => {
    expect(distance({ x: 5, y: 3 }, { a: { x: 0, y: 0 }, b: { x: 10, y: 0 } })).toBe(3);
    expect(distance({ x: 13, y: 4 }, { a: { x: 0, y: 0 }, b: { x: 10, y: 0 } })).toBe(5);
    const targets: Target[] = [
      { id: 'link:1-2', shape: { a: { x: 0, y: 0 }, b: { x: 100, y: 0 } } },
      { id: 'link:2-3', shape: { a: { x: 0, y: 6 }, b: { x: 100, y: 6 } } },
      { id: 'node:1', shape: { at: { x: 0, y: 0 }, radius: 10 } },
    ];
    expect(hit(targets, { x: 50, y: 2 })?.id).toBe('link:1-2');
    expect(hit(targets, { x: 50, y: 5 })?.id).toBe('link:2-3');
    expect(hit(targets, { x: 8, y: 0 })?.id).toBe('node:1');
    expect(hit(targets, { x: 50, y: 30 })).toBeNull();
  });

  it('of a centre’s network stand about it', () => {
    const model = {
      nodes: ['1', '2', '3'].map((id) => ({ id, position: null, state: `sensor.${id}.state` })),
      links: ['1', '2', '3'].map((from) => ({ id: `${from}-fused`, from, to: 'fused', state: null })),
      centre: 'fused',
    };
    const picture = pictureOf(model, 200, 100);
    expect(picture.nodes.find(({ centre }) => centre)?.at).toEqual({ x: 100, y: 50 });
    expect(picture.links.every(({ alone }) => alone)).toBe(true);
    expect(pictureTargets(picture, new Set(['link:2-fused', 'node:3'])).map(({ id }) => id)).toEqual(['link:2-fused', 'node:3']);
  });
});

describe('attacks that the server knows', () => {
  const kinds = kindsOf({
    attacks: [
      { id: 'bias', title: { en: 'Bias', zh: '偏差' }, acts_on: ['sensor', 'link'], parameters: [{ name: 'vector', type: 'vector', default: [15, 15, 0], required: false }] },
      { id: 'ramp', title: { en: 'Ramp', zh: '斜坡' }, acts_on: ['sensor'], parameters: [{ name: 'slope', type: 'vector', default: null, required: true }] },
      { id: 'new', title: { en: 'New', zh: '新' } },
    ],
  });

  it('say where they act; one that does not may act anywhere', () => {
    expect(kinds.map(({ actsOn }) => actsOn)).toEqual([['link', 'sensor'], ['sensor'], ['link', 'actuator', 'sensor']]);
    expect(kindsOf(null)).toEqual([]);
  });

  it('begin at once unless they must be asked; default vectors take the size of what they meet', () => {
    expect(kinds.map(beginsAtOnce)).toEqual([true, false, true]);
    expect(fittingParams(kinds[0]!, 3)).toEqual({});
    expect(fittingParams(kinds[0]!, 1)).toEqual({ vector: [15] });
    expect(fittingParams(kinds[0]!, 5)).toEqual({ vector: [15, 15, 0, 0, 0] });
    expect(fittingParams(kinds[0]!, 0)).toEqual({});
  });

  it('are offered as the server’s examples have them, in the order of what one does most', () => {
    const row = (attack: string, params: Record<string, unknown> | null, reason: string | null) => ({ attack, title: { en: '', zh: '' }, channel: 'sensor' as const, place: 'sensor:1', params, reason, cells: {} });
    const told = offersAt(kinds, 'sensor', [row('ramp', { slope: [1, 2], limit: 3 }, null), row('new', null, 'nobody hears it')], 3);
    expect(told.map(({ kind, atOnce, params, reason }) => [kind.id, atOnce, params, reason])).toEqual([
      ['bias', true, {}, null],
      ['ramp', true, { slope: [1, 2, 2], limit: 3 }, null],
      ['new', true, {}, 'nobody hears it'],
    ]);
    expect(offersAt(kinds, 'link', [], 1).map(({ kind, params }) => [kind.id, params])).toEqual([['bias', { vector: [15] }], ['new', {}]]);
    expect(resized({ pieces: [[1, 2]], vector: [] }, 4)).toEqual({ pieces: [[1, 2]], vector: [] });
  });

  it('are judged by a document that says all of the run', () => {
    expect(judgedByDocument({ input: 'simulate', design: { a: { eps: 1 } } })).toBe(true);
    expect(judgedByDocument({ input: { trace: '3' }, design: {} })).toBe(false);
    expect(judgedByDocument({ input: 'simulate', design: { a: { solver: 'DSDP' } } })).toBe(false);
  });

  it('are sent with the times that were given', () => {
    expect(sentTimes(always)).toEqual({});
    expect(sentTimes({ from: 5, to: 9, bursts: { every: 4, for: 1 }, budget: 2 })).toEqual({ from: 5, to: 9, schedule: { every: 4, for: 1, budget: 2 } });
    expect(sentTimes({ ...always, budget: 3 })).toEqual({ schedule: { budget: 3 } });
  });
});

const run = {
  document: {
    adversary: {
      early: { type: 'dos', on: ['link:*'], from: 5, to: 9, params: {} },
      late: { type: 'replay', on: ['sensor:1'], from: 90, to: null, params: {} },
      off: { type: 'dos', on: ['link:*'], from: 200, enabled: false },
      own: { type: 'replay', on: ['sensor:1'], from: 1, to: null, params: { case: 1, record_from: 50, record_to: 100, start: null } },
    },
  },
  commands: [
    { k: 20, body: { attack: { id: 'a1', type: 'dos', on: ['link:1-2'], params: {} } } },
    { k: 26, body: { end_attack: 'a1' } },
    { k: 40, body: { params: { 'adversary.late.enabled': false } } },
    { k: 44, body: { params: { 'adversary.late.enabled': true } } },
  ],
};
const marks = [attack(5, 'begin', 'early'), attack(10, 'end', 'early'), attack(20, 'begin', 'a1'), attack(26, 'end', 'a1'), attack(45, 'begin', 'own')];

describe('attacks as stretches of time', () => {
  const spans = spansOf(run, marks, 60);
  it('come from the document, the commands and the marks', () => {
    expect(spans.map(({ id, from, to, begun, active, command }) => [id, from, to, begun, active, command])).toEqual([
      ['early', 5, 9, true, false, null],
      ['a1', 20, 25, true, false, 20],
      ['own', 45, null, true, true, null],
      ['late', 90, null, false, false, null],
    ]);
  });

  it('touch the places that they name', () => {
    expect(covers(['link:*'], 'link:1-2')).toBe(true);
    expect(covers(['sensor:1.range'], 'sensor:1')).toBe(true);
    expect(covers(['sensor:11'], 'sensor:1')).toBe(false);
    expect(placeText(['link:1-2', 'sensor:3', 'link:*'], { every: 'all links', kinds: { sensor: 'sensor' } })).toBe('1→2, sensor 3, all links');
  });

  it('lie in rows, those of one time below one another', () => {
    const one = (id: string, from: number, to: number | null): AttackSpan => ({ ...spans[0]!, id, from, to });
    expect([...barRows([one('a', 1, 5), one('b', 3, 9), one('c', 6, 7), one('d', 6, null), one('e', 8, 8)], 10)]).toEqual([['a', 0], ['b', 1], ['c', 0], ['d', 2], ['e', 0]]);
  });

  it('reach as far as their plans, not beyond the run', () => {
    expect(plannedEnd(spans, 60, null)).toBe(100);
    expect(plannedEnd(spans, 60, 95)).toBe(95);
    expect(plannedEnd([], 60, null)).toBe(0);
  });
});

describe('the delay until a lane notices', () => {
  const model = {
    lanes: ['a', 'b', 'c', 'd'].map((id) => ({ id, adversary: id !== 'd' })),
    links: [{ id: '1-2', from: '1', to: '2', state: null }],
    signals: ['lane.a.1', 'lane.a.2', 'lane.b.fused', 'lane.d.1'].flatMap((one) => [{ name: `${one}.alarm` }, { name: `${one}.threshold` }]).concat({ name: 'lane.c.1.alarm' }),
  } as unknown as Parameters<typeof noticesOf>[1];
  const span = (on: string[], from: number, to: number | null): AttackSpan => ({ id: 'x', entry: { type: 'dos', on }, command: null, from, to, begun: true, active: to === null, acted: [{ from, to }] });
  const of = (one: AttackSpan, list: Mark[], head = 60, held = 0): unknown[] => noticesOf(one, model, list, head, held).map(({ notice }) => notice);

  it('counts from the attack’s begin to the lane’s first alarm there', () => {
    const list = [alarm(12, 'begin', 'a', '1'), alarm(13, 'end', 'a', '1'), alarm(24, 'begin', 'a', '1'), alarm(27, 'begin', 'a', '2'), alarm(22, 'begin', 'b', 'fused')];
    list.sort((x, y) => x.k - y.k);
    expect(of(span(['sensor:2'], 20, null), list)).toEqual([{ kind: 'noticed', k: 27, ticks: 7 }, { kind: 'noticed', k: 22, ticks: 2 }, { kind: 'none' }, { kind: 'spared' }]);
    expect(of(span(['link:1-2'], 20, null), list)[0]).toEqual({ kind: 'noticed', k: 27, ticks: 7 });
    expect(of(span(['link:*'], 20, null), list)[0]).toEqual({ kind: 'noticed', k: 24, ticks: 4 });
    expect(reachedNodes(span(['sensor:3.range', 'actuator:4'], 1, 2), { links: [] })).toEqual(new Set(['3', '4']));
  });

  it('says so where nothing was noticed, where it is too early, and where an alarm was on before', () => {
    expect(of(span(['sensor:1'], 20, null), [])[0]).toEqual({ kind: 'waiting', ticks: 41 });
    expect(of(span(['sensor:1'], 20, 30), [alarm(31, 'begin')])[0]).toEqual({ kind: 'missed' });
    expect(of(span(['sensor:1'], 20, 30), [alarm(30, 'begin')])[0]).toEqual({ kind: 'noticed', k: 30, ticks: 10 });
    expect(of(span(['sensor:1'], 20, 30), [alarm(15, 'begin'), alarm(25, 'end'), alarm(28, 'begin')])[0]).toEqual({ kind: 'already', since: 15 });
    expect(of(span(['sensor:1'], 20, 30), [alarm(15, 'begin'), alarm(20, 'end'), alarm(20, 'begin')])[0]).toEqual({ kind: 'noticed', k: 20, ticks: 0 });
    expect(of(span(['sensor:1'], 20, 30), [alarm(28, 'begin')], 60, 25)[0]).toEqual({ kind: 'unknown' });
  });
});

describe('an attack that is dragged', () => {
  it('moves as a whole or by an end, within the run and at least a tick long', () => {
    expect(dragged({ from: 10, to: 20 }, 'body', 5.4, 100, 20)).toEqual({ from: 15, to: 25 });
    expect(dragged({ from: 10, to: 20 }, 'body', -50, 100, 20)).toEqual({ from: 1, to: 11 });
    expect(dragged({ from: 10, to: 20 }, 'body', 500, 100, 20)).toEqual({ from: 90, to: 100 });
    expect(dragged({ from: 10, to: 20 }, 'from', 50, 100, 20)).toEqual({ from: 20, to: 20 });
    expect(dragged({ from: 10, to: 20 }, 'to', -50, 100, 20)).toEqual({ from: 10, to: 10 });
    expect(dragged({ from: 10, to: null }, 'body', 3, 100, 60)).toEqual({ from: 13, to: null });
    expect(dragged({ from: 10, to: null }, 'to', -5, 100, 60)).toEqual({ from: 10, to: 55 });
  });

  it('is taken at an end or by its body, however short', () => {
    expect([100, 106, 110, 195, 204].map((x) => gripAt(x, 100, 200))).toEqual(['from', 'from', 'body', 'to', 'to']);
    expect([100, 103, 105].map((x) => gripAt(x, 100, 106))).toEqual(['from', 'body', 'to']);
  });

  const spans = spansOf(run, marks, 60);
  const find = (id: string): AttackSpan => spans.find((one) => one.id === id)!;

  it('forks before both its times; a document’s attack keeps all but them, what came by hand later is kept', () => {
    expect(proposalFor(run, spans, find('early'), { from: 8, to: 12 }, 60, true)).toEqual({
      kind: 'fork',
      k: 4,
      patch: { adversary: { early: { from: 8, to: 12 }, a1: { type: 'dos', on: ['link:1-2'], from: 20, to: 25, params: {} } } },
      record: false,
      lost: 2,
    });
    expect(proposalFor(run, spans, find('early'), { from: 2, to: 6 }, 60, false)).toMatchObject({ kind: 'fork', k: 1 });
  });

  it('by hand is put into the fork from before its command on', () => {
    expect(proposalFor(run, spans, find('a1'), { from: 30, to: 35 }, 60, true)).toMatchObject({ kind: 'fork', k: 19, patch: { adversary: { a1: { type: 'dos', on: ['link:1-2'], from: 30, to: 35 } } } });
  });

  it('whose parameters say when it acts is switched off, and made anew with times from outside', () => {
    const { patch, record, k } = proposalFor(run, spans, find('own'), { from: 70, to: 80 }, 60, false) as Extract<ReturnType<typeof proposalFor>, { kind: 'fork' }>;
    expect(k).toBe(44);
    expect(record).toBe(true);
    expect(patch.adversary).toEqual({ own: null, own_moved: { type: 'replay', on: ['sensor:1'], from: 70, to: 80, params: {} } });
  });

  it('that has not begun is started anew in a live run, if the new time lies ahead, too', () => {
    expect(proposalFor(run, spans, find('late'), { from: 95, to: 99 }, 60, true)).toEqual({ kind: 'anew', stop: 'late', attack: { type: 'replay', on: ['sensor:1'], from: 95, to: 99, params: {} } });
    expect(proposalFor(run, spans, find('late'), { from: 50, to: 55 }, 60, true)).toMatchObject({ kind: 'fork', k: 49, patch: { adversary: { late: { from: 50, to: 55 } } } });
    expect(proposalFor(run, spans, find('late'), { from: 95, to: 99 }, 60, false)).toMatchObject({ kind: 'fork', k: 60 });
  });
});
