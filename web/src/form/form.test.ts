import { describe, expect, it } from 'vitest';
import { check, place } from './check';
import { commandLine, shellWord } from './command_line';
import { fieldsOf } from './fields';
import { type JsonObject } from './json';
import { addAttack, addLane, allFields, attackTypesOf, duplicate, makeGroups, methodsOf, remove, set, setMethod, startOf } from './model';
import { apply, changes, diff } from './patch';
import { at, pointer, put, steps } from './pointer';
import type { Schema } from './schema';
import { readPatch, writePatch } from './share';

const schema: Schema = {
  type: 'object',
  additionalProperties: false,
  properties: {
    id: { type: 'string' },
    time: {
      type: 'object',
      required: ['dt'],
      properties: {
        dt: { type: 'number', exclusiveMinimum: 0, 'x-unit': 's' },
        steps: { anyOf: [{ type: 'integer', minimum: 1 }, { type: 'null' }], default: 30, description: 'Last tick', 'x-zh': '最后一步' },
      },
    },
    plant: {
      type: 'object',
      properties: {
        type: { enum: ['unicycle'] },
        params: { type: 'object', properties: { kappa: { type: 'number', minimum: 0, maximum: 2, 'x-symbol': 'κ', default: 1 } } },
      },
    },
    network: {
      type: 'object',
      properties: {
        graph: { enum: ['ladder', 'ring'] },
        open: { anyOf: [{ type: 'string', enum: ['ladder', 'ring'] }, { type: 'string', pattern: '^knn[1-9]$' }] },
        edges: { type: 'array', items: { type: 'array', items: { type: ['string', 'integer'] } } },
      },
    },
    adversary: {
      type: 'object',
      additionalProperties: {
        oneOf: [
          { properties: { type: { const: 'dos_fdi' }, params: { type: 'object', properties: { pdos: { type: 'number', minimum: 0, maximum: 1, default: 0.2, 'x-live': true } } } } },
          { properties: { type: { const: 'replay' }, params: { type: 'object', properties: { delay: { type: 'integer', minimum: 1, default: 5 } } } } },
        ],
      },
    },
    lanes: {
      type: 'object',
      additionalProperties: {
        type: 'object',
        properties: { method: { enum: ['consensus_ekf', 'isolated'] } },
        allOf: [
          { if: { properties: { method: { const: 'consensus_ekf' } } }, then: { $ref: '#/$defs/consensus_ekf' } },
          { if: { properties: { method: { const: 'isolated' } } }, then: { properties: { params: { type: 'object', properties: {} } } } },
        ],
      },
    },
    noise: {
      type: 'object',
      properties: {
        Q: { anyOf: [{ type: 'array', items: { type: 'number', minimum: 0 }, minItems: 3, maxItems: 3 }, { type: 'array', items: { type: 'array', items: { type: 'number' } } }] },
      },
    },
  },
  $defs: {
    consensus_ekf: {
      properties: {
        params: {
          type: 'object',
          properties: {
            tau: { type: 'number', minimum: 0, default: 0.01, title: 'Step margin', description: 'a number >= 0', 'x-zh': '步长裕度', 'x-live': true },
            delta: { type: ['number', 'null'], minimum: 0, default: null },
            gate: { type: ['number', 'null'], minimum: 0, default: 9 },
          },
        },
      },
    },
  },
};

const preset: JsonObject = {
  id: 'consensus',
  time: { dt: 1, steps: 30 },
  plant: { type: 'unicycle', params: { kappa: 0.5 } },
  network: { graph: 'ladder' },
  adversary: { links: { type: 'dos_fdi', params: { pdos: 0.2 } } },
  lanes: {
    consensus: { method: 'consensus_ekf', params: { tau: 0.01, delta: null, gate: 9 } },
    isolated: { method: 'isolated', params: {} },
  },
  noise: { Q: [1, 1, 1] },
};

function field(document: JsonObject, wanted: string) {
  const found = allFields(makeGroups(schema, document)).find((one) => one.pointer === wanted);
  if (!found) throw new Error(`no field ${wanted}`);
  return found;
}

describe('form from schema', () => {
  it('groups the fields in reading order', () => {
    expect(makeGroups(schema, preset).map((group) => group.id)).toEqual(['time', 'plant', 'network', 'adversary', 'lanes', 'noise']);
  });

  it('reads kind, unit, range, default and both languages', () => {
    const tau = field(preset, '/lanes/consensus/params/tau');
    expect(tau).toMatchObject({ kind: 'number', minimum: 0, default: 0.01, live: true, value: 0.01 });
    expect(tau.meaning).toEqual({ en: 'Step margin', zh: '步长裕度' });
    expect(field(preset, '/time/dt')).toMatchObject({ unit: 's', exclusiveMinimum: 0 });
    expect(field(preset, '/time/steps')).toMatchObject({ kind: 'integer', nullable: true, minimum: 1 });
    expect(field(preset, '/plant/params/kappa').symbol).toBe('κ');
    expect(field(preset, '/network/graph')).toMatchObject({ kind: 'choice', choices: ['ladder', 'ring'] });
  });

  it('offers names where others may be typed, and leaves what it cannot draw as JSON', () => {
    const open = field(preset, '/network/open');
    expect(open).toMatchObject({ kind: 'text', choices: ['ladder', 'ring'] });
    expect(check(open, 'knn3')).toBeUndefined();
    expect(check(open, undefined)).toBeUndefined();
    expect(field(set(preset, ['network', 'edges'], [['1', '2']]), '/network/edges').kind).toBe('json');
    expect(field(set(preset, ['network', 'edges'], [[1, 2]]), '/network/edges').kind).toBe('matrix');
  });

  it('takes vector or matrix from what the document holds', () => {
    expect(field(preset, '/noise/Q')).toMatchObject({ kind: 'vector', minItems: 3, minimum: 0 });
    const full = set(preset, ['noise', 'Q'], [[1, 0], [0, 1]]);
    expect(field(full, '/noise/Q')).toMatchObject({ kind: 'matrix', columns: 2 });
  });

  it('shows the parameters of the method a lane has', () => {
    const lane = makeGroups(schema, preset).find((group) => group.id === 'lanes')!.sections[0]!;
    expect(lane.sections.map((section) => section.name)).toEqual(['consensus', 'isolated']);
    expect(fieldsOf(lane.sections[0]!).map((one) => one.name)).toEqual(['method', 'tau', 'delta', 'gate']);
    expect(fieldsOf(lane.sections[1]!).map((one) => one.name)).toEqual(['method']);
    const changed = setMethod(preset, 'isolated', 'consensus_ekf');
    expect(field(changed, '/lanes/isolated/params/tau').value).toBeUndefined();
  });

  it('knows the methods and attacks that can be chosen', () => {
    expect(methodsOf(schema)).toEqual(['consensus_ekf', 'isolated']);
    expect(attackTypesOf(schema)).toEqual(['dos_fdi', 'replay']);
  });
});

describe('lanes and attacks', () => {
  it('adds, duplicates and removes without touching the original', () => {
    const before = JSON.stringify(preset);
    const added = addLane(preset, 'consensus_ekf');
    expect(added.id).toBe('consensus_ekf');
    const twin = duplicate(added.document, 'lanes', 'consensus');
    expect(twin.id).toBe('consensus_2');
    expect(at(twin.document, ['lanes', 'consensus_2', 'params', 'tau'])).toBe(0.01);
    expect(duplicate(twin.document, 'lanes', 'consensus_2').id).toBe('consensus_3');
    const gone = remove(twin.document, 'lanes', 'isolated');
    expect(diff(preset, gone).lanes).toMatchObject({ isolated: null });
    expect(addAttack(preset, 'replay').document.adversary).toMatchObject({ replay: { type: 'replay' } });
    expect(JSON.stringify(preset)).toBe(before);
  });
});

describe('patch', () => {
  it('says only what changed and leads there', () => {
    const changed = set(set(preset, ['lanes', 'consensus', 'params', 'tau'], 0.02), ['time', 'steps'], 60);
    expect(diff(preset, changed)).toEqual({ time: { steps: 60 }, lanes: { consensus: { params: { tau: 0.02 } } } });
    expect(apply(preset, diff(preset, changed))).toEqual(changed);
    expect(diff(preset, preset)).toEqual({});
  });

  it('replaces arrays whole and drops removed members', () => {
    expect(diff({ a: [1, 2], b: 1 }, { a: [1, 3] })).toEqual({ a: [1, 3], b: null });
    expect(apply({ a: { b: 'c' } }, { a: { b: 'd', c: null } })).toEqual({ a: { b: 'd' } });
    expect(apply({ a: [1] }, 'text')).toBe('text');
  });

  it('lists the leaves that differ', () => {
    expect(changes(preset, set(preset, ['lanes', 'consensus', 'params', 'tau'], 5))).toEqual([
      { path: ['lanes', 'consensus', 'params', 'tau'], from: 0.01, to: 5 },
    ]);
    expect(changes({ a: 1 }, {})).toEqual([{ path: ['a'], from: 1, to: undefined }]);
  });

  it('sends the patch where it is enough and the document where it is not', () => {
    const same = startOf('consensus', preset, set(preset, ['time', 'steps'], 5), schema);
    expect(same).toEqual({ scenario: 'consensus', patch: { time: { steps: 5 } } });
    const automatic = set(preset, ['lanes', 'consensus', 'params', 'gate'], null);
    expect(startOf('consensus', preset, automatic, schema)).toEqual({ scenario: automatic });
    const wasSet = set(preset, ['lanes', 'consensus', 'params', 'delta'], 2);
    expect(startOf('consensus', wasSet, preset, schema)).toEqual({
      scenario: 'consensus', patch: { lanes: { consensus: { params: { delta: null } } } },
    });
  });
});

describe('check', () => {
  it('finds values out of range and wrong types', () => {
    const dt = field(preset, '/time/dt');
    expect(check(dt, 0)).toMatchObject({ code: 'range', low: 0, openLow: true });
    expect(check(dt, 0.001)).toBeUndefined();
    expect(check(dt, 'x')).toMatchObject({ code: 'number' });
    expect(check(dt, Number.NaN)).toMatchObject({ code: 'number' });
    expect(check(field(preset, '/time/steps'), 1.5)).toEqual({ code: 'integer' });
    expect(check(field(preset, '/time/steps'), null)).toBeUndefined();
    expect(check(dt, null)).toEqual({ code: 'missing' });
    expect(check(dt, undefined)).toEqual({ code: 'missing' });
    expect(check(field(preset, '/network/graph'), 'star')).toMatchObject({ code: 'choice' });
  });

  it('checks the size and every number of a vector', () => {
    const q = field(preset, '/noise/Q');
    expect(check(q, [1, 1])).toEqual({ code: 'size', least: 3, most: 3 });
    expect(check(q, [1, -1, 1])).toMatchObject({ code: 'range', low: 0 });
    expect(check(q, [1, 1, 0])).toBeUndefined();
    const matrix = field(set(preset, ['noise', 'Q'], [[1, 0], [0, 1]]), '/noise/Q');
    expect(check(matrix, [[1, 0], [0]])).toEqual({ code: 'ragged' });
  });

  it("puts the server's problems to their fields", () => {
    const fields = allFields(makeGroups(schema, preset));
    const placed = place(
      [
        { pointer: '/patch/noise/Q/1', detail: 'negative' },
        { pointer: '/time/dt', detail: 'zero' },
        { pointer: '/plant', detail: 'does not fit' },
        { pointer: '', detail: 'too large' },
      ],
      fields,
    );
    expect(placed.byField.get('/noise/Q')?.[0]?.detail).toBe('negative');
    expect(placed.byField.get('/plant/type')?.[0]?.detail).toBe('does not fit');
    expect(placed.first).toBe('/time/dt');
    expect(placed.rest.map((problem) => problem.detail)).toEqual(['too large']);
  });
});

describe('pointers', () => {
  it('escapes and reads back', () => {
    expect(pointer(['a/b', 'c~d'])).toBe('/a~1b/c~0d');
    expect(steps('/a~1b/c~0d')).toEqual(['a/b', 'c~d']);
    expect(steps('')).toEqual([]);
  });

  it('reads and writes inside arrays', () => {
    const document: JsonObject = { a: [[1, 2], [3, 4]], b: [1] };
    expect(at(document, ['a', '1', '0'])).toBe(3);
    expect(at(document, ['a', 'x'])).toBeUndefined();
    expect(put(document, ['b', '0'], 7)).toEqual({ a: [[1, 2], [3, 4]], b: [7] });
    expect(document.b).toEqual([1]);
  });
});

describe('command line and address', () => {
  it('says the changes as --set, quoted for the shell', () => {
    const changed = set(set(preset, ['noise', 'Q'], [1, 2, 3]), ['time', 'steps'], null);
    expect(commandLine('consensus', preset, changed, 4)).toEqual({
      text: "vigil run consensus --seed 4 --set time.steps=null --set 'noise.Q=[1,2,3]'",
      patchFile: false,
    });
    expect(commandLine('consensus', preset, remove(changed, 'lanes', 'isolated'), undefined)).toEqual({
      text: 'vigil run consensus --patch changes.json',
      patchFile: true,
    });
    expect(shellWord("it's")).toBe(`'it'\\''s'`);
    expect(shellWord('a.b=0.02')).toBe('a.b=0.02');
  });

  it('reads a patch from the address with care', () => {
    const patch = { time: { steps: 5 } };
    expect(readPatch(writePatch(patch))).toEqual(patch);
    expect(readPatch(null)).toEqual({});
    expect(readPatch('[1]')).toBeUndefined();
    expect(readPatch('{')).toBeUndefined();
    const nasty = readPatch('{"__proto__":{"polluted":true},"a":1}');
    expect(nasty).toEqual({ a: 1 });
    expect(({} as Record<string, unknown>).polluted).toBeUndefined();
  });
});
