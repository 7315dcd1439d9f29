/// Where a description of a linear system can start.
import type { Json, JsonObject } from '../../../form/json';

export const startNames = ['integrator', 'chain', 'feedback', 'empty'] as const;
export type StartName = (typeof startNames)[number];

const sensor = (C: number[][], R: number[][]): JsonObject => ({ sensor: { type: 'linear', params: { C, R } } });

function system(parts: { en: string; zh: string } & JsonObject): JsonObject {
  const { en, zh, ...rest } = parts;
  return { vigil: 1, id: 'own-system', title: { en, zh }, family: 'consensus', controller: { type: 'none' }, network: { graph: 'none' }, adversary: {}, ...rest };
}

const diagonal = (size: number, value: number): Json[][] => Array.from({ length: size }, (_, i) => Array.from({ length: size }, (__, j) => (i === j ? value : 0)));

/** A mass pushed about by white noise, of which the position alone is measured. */
const integrator = (): JsonObject =>
  system({
    en: 'A double integrator, its position measured',
    zh: '双积分器，仅测量位置',
    time: { dt: 0.1, steps: 300 },
    plant: { type: 'linear', params: { A: [[0, 1], [0, 0]], time: 'continuous', states: ['position', 'velocity'] } },
    nodes: { '1': sensor([[1, 0]], [[0.04]]) },
    // What white acceleration of density 0.1 does in a tick.
    noise: { Q: [[0.000033, 0.0005], [0.0005, 0.01]], P0: diagonal(2, 0.25) },
    initial: { truth: [0, 1] },
    lanes: { alone: { method: 'local_ekf' } },
  });

/** Four tanks in a row, one gauge at each; their links are jammed for a while. */
const chain = (): JsonObject =>
  system({
    en: 'A chain of four, one state seen at each node',
    zh: '四级耦合链，每个节点只测一个状态',
    time: { dt: 1, steps: 200 },
    plant: { type: 'linear', params: { A: [[0.9, 0.08, 0, 0], [0.08, 0.84, 0.08, 0], [0, 0.08, 0.84, 0.08], [0, 0, 0.08, 0.9]] } },
    nodes: Object.fromEntries([0, 1, 2, 3].map((i) => [String(i + 1), sensor([[0, 1, 2, 3].map((j) => (i === j ? 1 : 0))], [[0.1]])])),
    network: { graph: 'path' },
    noise: { Q: diagonal(4, 0.02), P0: diagonal(4, 1) },
    initial: { truth: [2, -1, 1, -2] },
    adversary: { jam: { type: 'dos', on: ['link:*'], from: 80, to: 120 } },
    lanes: { consensus: { method: 'kalman_consensus' }, clean: { method: 'kalman_consensus', adversary: false }, alone: { method: 'local_ekf' } },
  });

/** A plant that grows by itself and is held by u = -K x of each lane's own estimate. */
const feedback = (): JsonObject =>
  system({
    en: 'An unstable plant under feedback',
    zh: '反馈镇定的不稳定对象',
    time: { dt: 0.1, steps: 300 },
    plant: { type: 'linear', params: { A: [[1.1, 0.2], [0, 0.8]], B: [[1], [0.5]] } },
    controller: { type: 'feedback', params: { K: [[0.6, 0.2]] } },
    nodes: { '1': sensor([[1, 0]], [[0.1]]) },
    noise: { Q: diagonal(2, 0.02), P0: diagonal(2, 1) },
    initial: { truth: [1, -1] },
    lanes: { alone: { method: 'local_ekf' } },
  });

const empty = (): JsonObject =>
  system({
    en: 'A linear system',
    zh: '线性系统',
    time: { dt: 1, steps: 200 },
    plant: { type: 'linear', params: { A: [[0, 0], [0, 0]] } },
    nodes: { '1': sensor([[0, 0]], [[1]]) },
    noise: { Q: diagonal(2, 0), P0: diagonal(2, 1) },
    initial: { truth: [0, 0] },
    lanes: {},
  });

const makers: Readonly<Record<StartName, () => JsonObject>> = { integrator, chain, feedback, empty };

export const start = (name: StartName): JsonObject => makers[name]();
