/// A run with a fusion centre as the server tells it, for tests.
import type { RunDetail, Signal } from '../../../api/types';

export const lanes = ['unprotected', 'two_step', 'contamination', 'secrecy_code_a'];
const states = ['x1', 'x2'];
const eves: Record<string, string[]> = { unprotected: ['fusing', 'zero'], two_step: ['differencing', 'window_mean', 'zero'], contamination: ['fusing', 'zero'], secrecy_code_a: ['fusing', 'zero'] };
const views = ['single', 'stream'];

const ofLane = (lane: string): string[] => [
  ...['1', '2'].flatMap((node) => [
    ...states.flatMap((c) => [`${node}.estimate.${c}`, `${node}.sent.${c}`]),
    `${node}.square`, `${node}.trace`, `${node}.sent_square`,
    ...(lane === 'contamination' ? [...states.map((c) => `${node}.contaminated.${c}`), ...states.map((c) => `${node}.compensated.${c}`), `${node}.compensated_square`, `${node}.compensated_trace`] : []),
    ...(lane === 'two_step' ? views.map((view) => `${node}.loss.${view}`) : []),
  ]),
  ...['fused', 'optimal', ...eves[lane]!.map((variant) => `eve.${variant}`)].flatMap((who) => [...states.map((c) => `${who}.estimate.${c}`), `${who}.square`, `${who}.trace`]),
  ...eves[lane]!.flatMap((variant) => [`eve.${variant}.ci`, `eve.${variant}.ci_mse`]),
  'ci', 'rank', 'ci_mse',
].map((rest) => `lane.${lane}.${rest}`);

const names = [...states.map((c) => `truth.${c}`), ...['1', '2'].flatMap((node) => [`sensor.${node}.y`, `link.${node}-fused.state`, `link.${node}-fused.overheard`]), ...lanes.flatMap(ofLane)];

/** The node of a signal: "1", "fused", "eve.fusing"; null where the signal is the whole lane's. */
function nodeOf(rest: readonly string[]): string | null {
  if (rest.length < 2) return null;
  return rest[0] === 'eve' ? `eve.${rest[1]}` : rest[0]!;
}

export const signals = names.map((name, id): Signal => {
  const parts = name.split('.');
  const lane = parts[0] === 'lane' ? parts[1]! : null;
  return { id, name, unit: '', kind: 'scalar', lane, node: lane ? nodeOf(parts.slice(2)) : null, link: parts[0] === 'link' ? parts[1] : null };
});

const view = (mu: number | null, pLoss: number, eps: number | null): object => ({ mu, p_loss: pLoss, eps_at_delta: eps, ...(mu === null ? { infinite: true } : {}) });

export const twoStep = {
  gamma: 2.18, epsilon: Math.LN2, delta: 0.1, leak: 0.0085, slope: 0.0034, dp_ok: true, views_design_mu: 0.45876,
  trace_legitimate: 0.0127, trace_optimal: 0.0071, trace_eavesdropper: { differencing: 0.3564, window_mean: 0.0242 },
  views: { single: { 1: view(0.345, 0.03, 0.1), 2: view(0.441, 0.087, 0.22) }, stream: { 1: view(1.131, 0.48, 1.44), 2: view(null, 1, null) } },
  releases: [{ node: '1', component: 'x1', std: 0.2, shift: 0.03 }, { node: '2', component: 'x1', std: 0, shift: 0.1 }],
};

export const surfaces = {
  kappa: { values: [5, 10, 20], pdfe: [2.13, 1.097, 0.5805], cdfe: [1.661, 0.8632, 0.4645] },
  epsilon_delta: { epsilon: [0.3, 1], delta: [0.05, 0.1, 0.2], pdfe: [[6, 4.727, 3], [0.8, 0.6171, 0.4]], cdfe: [[5, 3.666, 2], [0.7, 0.4927, 0.3]] },
};

const lane = (type: string | null, params: object = {}): object => ({ method: 'fusion', params: { filter: 'stationary' }, ...(type ? { protection: { type, params } } : {}) });

export const run = {
  id: '7', scenario: 'privacy-engine', family: 'privacy', title: { en: 'An engine', zh: '发动机' }, state: 'finished', seed: 1, version: '0.1.0', pace: 'max', tags: [], note: '',
  created: '2026-01-01T00:00:00Z', started: '2026-01-01T00:00:00Z', progress: { k: 200, steps: 200, t: 200, dt: 1, ticks_per_second: null }, viewers: 0, faults: [], warnings: [], error: null, log: { gaps: 0 }, view: {}, commands: [], metrics: [],
  design: { two_step: twoStep, contamination: { null_dim: 2, contaminated: [1, 2] } },
  document: {
    family: 'privacy', time: { dt: 1, steps: 200 }, plant: { type: 'engine', params: {} }, adversary: { ears: { type: 'eavesdrop', on: ['link:*'] } },
    lanes: { unprotected: lane(null), two_step: lane('two_step'), contamination: lane('contamination'), secrecy_code_a: lane('secrecy_code', { code: 'A' }) },
  },
  world: { nodes: ['1', '2'].map((id) => ({ id, position: null })), links: ['1', '2'].map((id) => ({ id: `${id}-fused`, from: id, to: 'fused' })), lanes: lanes.map((id) => ({ id, method: 'fusion', adversary: true })), state: [] },
} as unknown as RunDetail;
