/// A run of two coupled subsystems as the server tells it, for tests.
import type { Metric, RunDetail, Signal } from '../../../api/types';

const lanes = ['intermediate_fast', 'intermediate_printed'];
const own = { 1: ['x1_1', 'x1_2'], 2: ['x2_1'] } as const;

const names = [
  ...Object.values(own).flat().map((component) => `truth.${component}`),
  ...['1', '2'].flatMap((node) => [`sensor.${node}.y1`, `sensor.${node}.y2`, `actuator.${node}.w1.injected`, `fault.${node}.f1`, `disturbance.${node}.d1`]),
  ...lanes.flatMap((lane) => (['1', '2'] as const).flatMap((node) => [...own[node].map((component) => `estimate.${component}`), 'attack.w1', 'fault.f1', 'innovation', 'error'].map((rest) => `lane.${lane}.${node}.${rest}`))),
];

export const signals = names.map((name, id): Signal => {
  const parts = name.split('.');
  const lane = parts[0] === 'lane' ? parts[1]! : null;
  return { id, name, unit: '', kind: 'scalar', lane, node: lane ? parts[2]! : null };
});

export function metric(lane: string, node: string, name: string, value: number): Metric {
  return { lane, node, name, variant: null, value };
}

export const record = {
  key: '00112233445566aa', holds: true, reason: '', solver: 'DSDP', verdict: 'solved', detail: '', iterations: 61, seconds: 0.4, objective: 22.55,
  gamma_d: [0.033, null], gamma_w: [0.034, 0.032], kappa: [6, 5], lambda_max_sigma: -0.00098, lambda_min_p: 0.01, max_real_pole: -0.61, fastest_pole: 997, norm_l: [1.5e5, 6.5e4],
  margins: [{ block: 'Sigma', value: 9.8e-4 }, { block: 'P 1', value: 0.01 }], poles: [[-0.61, 0], [-30, 12], [-30, -12]], matched: [true, false], L: [[[1, 2], [3, 4]], [[5], [6]]],
};

export const run = {
  id: '7', scenario: 'observer-pair', family: 'observer', title: { en: 'A pair', zh: '两个子系统' }, state: 'finished', seed: 1, version: '0.1.0', pace: 'max', tags: [], note: '',
  created: '2026-01-01T00:00:00Z', started: '2026-01-01T00:00:00Z', progress: { k: 20000, steps: 20000, t: 20, dt: 0.001, ticks_per_second: null }, viewers: 0, faults: [], warnings: [], error: null, log: { gaps: 0 }, view: {}, commands: [],
  metrics: [
    ...['1', '2'].map((node) => metric('intermediate_fast', node, 'rms_attack_error', 0.01)),
    metric('intermediate_printed', '1', 'rms_attack_error', 0.698),
    metric('intermediate_printed', '2', 'rms_attack_error', 0.801),
  ],
  design: { intermediate_fast: record, intermediate_printed: { ...record, solver: 'given', objective: null, max_real_pole: -0.533 } },
  document: {
    family: 'observer', time: { dt: 0.001, steps: 20000 }, plant: { type: 'pair', params: {} }, metrics: { window: { from: 8001 } },
    lanes: {
      intermediate_fast: { method: 'intermediate_observer', params: { structure: 'proposed', gains: 'design', preset: 'fast' } },
      intermediate_printed: { method: 'intermediate_observer', params: { structure: 'proposed', gains: 'printed' } },
    },
  },
  world: { nodes: ['1', '2'].map((id) => ({ id, position: null })), links: [], lanes: lanes.map((id) => ({ id, method: 'intermediate_observer', adversary: true })), state: [] },
} as unknown as RunDetail;
