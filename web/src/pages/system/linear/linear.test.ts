import { describe, expect, it } from 'vitest';
import { at, put } from '../../../form/pointer';
import { freeName, renamed } from '../copies';
import { addNode, removeNode, setBounded, setController, setInputs, setOutputs, setStates, setTable } from './edit';
import { addLaneOf, lanesOf, removeLanesOf } from './lanes';
import { channelNames, namePaths, setNames, stateNames } from './names';
import { pairsOf, setGraph, toggle } from './network';
import { opened, squareOf } from './open';
import { cellsAt, nodesOf, outputsOf, places, sensorPath, sizesOf } from './places';
import { start, startNames } from './starts';
import { viewOf, withView } from './view';
import { wrongPlaces } from './wrong';

const begun = (name: (typeof startNames)[number] = 'integrator') => opened(start(name))!;
const shape = (cells: unknown[][]): string => `${cells.length}x${cells[0]?.length ?? 0}`;

describe('a document that is opened', () => {
  it('stays as it is where every table is whole, and opening it again changes nothing', () => {
    for (const name of startNames) {
      expect(begun(name)).toEqual(start(name));
      expect(opened(begun(name))).toEqual(begun(name));
    }
  });

  it('gets the tables that numbers and diagonals stand for, and keeps all that the form does not show', () => {
    const short = {
      vigil: 1, id: 'short', metrics: { window: { from: 20 } }, log: { every: 2 },
      plant: { type: 'linear', params: { A: [[1.1, 0.2], [0, 0.8]], B: [[1], [0.5]] } },
      controller: { type: 'lqg', params: { Qc: [1, 10], Rc: 1, reference: 'zero' } },
      nodes: { a: { sensor: { type: 'linear', params: { C: [[1, 0]], R: 0.1, Mv: 0.2 } } } },
      noise: { Q: [0.1, 0.3], Mw: 0, law: 'laplace' },
      adversary: { replay: { type: 'replay', on: ['sensor:a'] } },
      lanes: { repaired: { method: 'mixed_filter', params: { tau: 40 } } },
    };
    const whole = opened(short)!;
    expect(whole.noise).toEqual({ Q: [[0.1, 0], [0, 0.3]], P0: [[0, 0], [0, 0]], law: 'laplace' });
    expect(at(whole, sensorPath('a'))).toEqual({ C: [[1, 0]], R: [[0.1]], Mv: [[0.2]] });
    expect(whole.controller).toEqual({ type: 'lqg', params: { Qc: [[1, 0], [0, 10]], Rc: [[1]], reference: 'zero' } });
    expect(at(whole, places.truth)).toEqual([0, 0]);
    for (const key of ['metrics', 'log', 'adversary', 'lanes'] as const) expect(whole[key]).toEqual(short[key]);
    expect(opened(whole)).toEqual(whole);
  });

  it('is refused where the plant or a sensor has no matrices', () => {
    expect(opened({ plant: { type: 'pair' }, nodes: {} })).toBeNull();
    expect(opened(put(start('integrator'), ['nodes', '1', 'sensor', 'type'], 'camera'))).toBeNull();
    expect(at(opened({ plant: { type: 'linear', params: { A: [0.5, 2], B: null, states: null } }, nodes: {} }), ['plant', 'params'])).toEqual({ A: [[0.5, 0], [0, 2]], states: null });
    expect(squareOf(2, 2)).toEqual([[2, 0], [0, 2]]);
  });
});

describe('what is pasted', () => {
  it('makes the system grow: every other table with it', () => {
    let system = setController(setInputs(begun('chain'), 2), 'lqg');
    system = setTable(system, places.A, Array.from({ length: 5 }, (_, i) => [0, 1, 2, 3, 4].map((j) => (i === j ? 1 : 0))));
    expect(sizesOf(system)).toEqual({ n: 5, m: 2 });
    expect(nodesOf(system).map((id) => shape(cellsAt(system, [...sensorPath(id), 'C'])))).toEqual(['1x5', '1x5', '1x5', '1x5']);
    expect([places.B, places.Q, places.P0, [...places.controller, 'Qc'], [...places.controller, 'Rc']].map((path) => shape(cellsAt(system, path)))).toEqual(['5x2', '5x5', '5x5', '5x5', '2x2']);
    expect(at(system, places.truth)).toEqual([2, -1, 1, -2, 0]);
  });

  it('into C gives the node outputs, as noisy as the last one, and the plant states', () => {
    const system = setTable(begun(), [...sensorPath('1'), 'C'], [[1, 0, 0], [0, 1, 0]]);
    expect(sizesOf(system).n).toBe(3);
    expect(outputsOf(system, '1')).toBe(2);
    expect(at(system, [...sensorPath('1'), 'R'])).toEqual([[0.04, 0], [0, 0.04]]);
    expect(cellsAt(system, [...sensorPath('1'), 'C'])).toEqual([[1, 0, 0], [0, 1, 0]]);
  });

  it('into B gives inputs, into K inputs and states', () => {
    expect(sizesOf(setTable(begun(), places.B, [[0, 1], [1, 0]]))).toEqual({ n: 2, m: 2 });
    const system = setTable(begun('feedback'), [...places.controller, 'K'], [[1, 2, 3], [4, 5, 6]]);
    expect(sizesOf(system)).toEqual({ n: 3, m: 2 });
    expect(at(system, [...places.controller, 'K'])).toEqual([[1, 2, 3], [4, 5, 6]]);
  });

  it('is cut at twelve', () => {
    expect(sizesOf(setTable(begun(), places.A, Array.from({ length: 14 }, () => new Array<number>(14).fill(1)))).n).toBe(12);
  });

  it('is named by its place where it holds no number', () => {
    expect(wrongPlaces(begun('feedback'))).toEqual([]);
    expect(wrongPlaces(put(begun('feedback'), [...places.controller, 'K'], [['x', 0]]))).toEqual(['/controller/params/K']);
    expect(wrongPlaces(put(put(begun(), ['time', 'dt'], ''), places.truth, [0, 'a']))).toEqual(['/initial/truth', '/time/dt']);
    expect(wrongPlaces(put(begun(), ['time', 'steps'], null))).toEqual([]);
  });
});

describe('the parts of a system', () => {
  it('shrink, and let their names go with what they named', () => {
    let system = setNames(begun(), namePaths.states, 'p, v');
    expect(stateNames(system)).toEqual(['p', 'v']);
    system = setStates(system, 3);
    expect(at(system, namePaths.states)).toEqual(['p', 'v', 'x3']);
    expect(at(setStates(system, 1), namePaths.states)).toEqual(['p']);
    expect(at(setInputs(setNames(setInputs(system, 1), namePaths.inputs, 'force'), 0), namePaths.inputs)).toBeUndefined();
    expect(at(setNames(system, namePaths.states, ' '), namePaths.states)).toBeUndefined();
    expect(channelNames(setOutputs(system, '1', 2), '1')).toEqual(['y1', 'y2']);
  });

  it('are nodes, which take their edges with them', () => {
    let system = setGraph(begun('chain'), 'ring');
    expect(pairsOf(system)).toEqual([['1', '2'], ['2', '3'], ['3', '4'], ['4', '1']]);
    system = toggle(system, '1', '3');
    expect(at(system, ['network', 'graph'])).toBe('edges');
    expect(pairsOf(toggle(system, '3', '1'))).toHaveLength(4);
    system = removeNode(system, '3');
    expect(pairsOf(system)).toEqual([['1', '2'], ['4', '1']]);
    expect(nodesOf(addNode(system))).toEqual(['1', '2', '4', '5'].toSorted());
    expect(pairsOf(put(system, ['network'], { graph: 'knn2' }))).toBeNull();
  });

  it('are noise, a controller, lanes', () => {
    const bounded = setBounded(begun('chain'), true);
    expect(shape(cellsAt(bounded, places.Mw))).toBe('4x4');
    expect(setBounded(bounded, false)).toEqual(begun('chain'));
    expect(setInputs(begun('feedback'), 0).controller).toEqual({ type: 'none' });
    expect(setController(begun('feedback'), 'none').controller).toEqual({ type: 'none' });
    let system = addLaneOf(addLaneOf(begun(), 'local_ekf'), 'local_ekf', true);
    expect(lanesOf(system, 'local_ekf')).toEqual(['alone', 'local_ekf', 'local_ekf_clean']);
    expect(at(system, ['lanes', 'local_ekf_clean'])).toEqual({ method: 'local_ekf', adversary: false });
    system = removeLanesOf(addLaneOf(system, 'centralized_ekf'), 'local_ekf');
    expect(Object.keys(system.lanes as object)).toEqual(['centralized_ekf']);
  });

  it('are drawn on the live page: hints follow the states, those of the reader stay', () => {
    const system = withView(begun(), begun());
    expect(system.view).toEqual({ plane: { components: ['position', 'velocity'] }, errors: ['position', 'velocity'] });
    const grown = withView(system, setStates(system, 3));
    expect(grown.view).toEqual(viewOf(grown));
    const own = put(system, ['view'], { errors: ['velocity'], detector: true });
    expect(withView(own, setStates(own, 3)).view).toEqual({ errors: ['velocity'], detector: true });
    expect(withView(own, setStates(own, 1)).view).toEqual({ detector: true });
  });

  it('are copied under a free name', () => {
    expect(freeName(new Set(['mine', 'mine-2']), 'mine')).toBe('mine-3');
    expect(freeName(new Set(['mine-2']), 'mine-2')).toBe('mine-3');
    expect(renamed(renamed({ id: 'a', title: { en: 'T', zh: '题' } }, 'a-2'), 'a-3').title).toEqual({ en: 'T (a-3)', zh: '题 (a-3)' });
  });
});
