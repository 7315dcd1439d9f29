/// Where a description can start: nothing, the source's example 3.1, and a system that no observer can see into.
import { emptySubsystem, withSizes, type Cells, type MatrixName, type SubsystemDraft, type SystemDraft } from './draft';

export const startNames = ['empty', 'pair', 'undetectable'] as const;
export type StartName = (typeof startNames)[number];

function subsystem(matrices: Partial<Record<MatrixName, number[][]>>, more: Partial<Omit<SubsystemDraft, 'matrices' | 'sizes'>>): SubsystemDraft {
  const width = (name: MatrixName): number => matrices[name]?.[0]?.length ?? 0;
  const sizes = { n: width('A'), m: width('B'), p: matrices.C?.length ?? 0, q: width('D'), dd: width('Dd'), g: width('G'), r: width('F') };
  const blank = emptySubsystem(sizes);
  return withSizes({ ...blank, ...more, matrices: { ...blank.matrices, ...matrices } }, sizes);
}

const column = (...values: number[]): number[][] => values.map((value) => [value]);
/** A piece without slope: until, offset, sine, cosine, rate, phase. */
const piece = (until: number, offset: number, sine: number, cosine: number, rate: number, phase = 0): number[] => [until, offset, 0, sine, cosine, rate, phase];
const pi = Math.PI;

/** Example 3.1 (specification, 8.1). */
function pair(): SystemDraft {
  const w1: Cells = [piece(2, 0, 0, 0, 0), piece(6, 0, 2, 0, pi), piece(20, 0, 0, 1, pi)];
  const w2: Cells = [piece(0.25, 0, 0, 0, 0), piece(5.5, 0, 0.5, 0, 5 * pi, -1), piece(20, 0, 0, 1, 0.5 * pi)];
  const f1: Cells = [piece(0.25, 0, 0, 0, 0), piece(3, 0, 0.5, 0, 20, -1), piece(20, 1, -1, 0, 5 * pi)];
  const f2: Cells = [piece(1.5, 0, 0, 0, 0), piece(3.5, 0, 0, 1, 5 * pi), piece(20, 0, 1, 0, 0.5 * pi)];
  const one = subsystem(
    {
      A: [[-1, 0, 0, 0], [1, -2, 0, 0], [1, 0, -1, 1.5], [0, 2, 0, -1]],
      B: column(1, 0, 1, 0),
      C: [[1, 0, 0, 0], [0, 1, 0.2, 0], [1, 1, 2, 0]],
      D: column(1, 0, 1, 0),
      Dd: column(-1, 0, 1, 0.5),
      F: column(1, 0, 1, 0),
      G: column(1, 0, 1),
    },
    { scalars: { alpha: 1, tau: 2, varsigma: 9, kappa: 6 }, phi: 'sine', x0: [0.03358, 0.005, 0, 0], signals: { w: [w1], d: [[piece(20, 0, 1, 0, 0.7 * pi)]], f: [f1], u: [] } },
  );
  const two = subsystem(
    {
      A: [[-1, 1, 0], [1, -2, 0], [1, 0, -1]],
      B: column(1, 1, 1),
      C: [[1, 2, -1], [-1, 0, 0], [1, 1, 2]],
      D: column(1, 1, 1),
      Dd: column(0, 1, -1),
      F: column(1, 0, 1),
      G: column(1, -2, 1),
    },
    { scalars: { alpha: -1, tau: 3, varsigma: 3, kappa: 5 }, phi: 'sine', x0: [-0.0626, 0, 0], signals: { w: [w2], d: [[piece(20, 0, 0, -1, 0.4 * pi)]], f: [f2], u: [] } },
  );
  return {
    subsystems: [one, two],
    couplings: [
      { from: 1, to: 0, H: [[-0.05, 0, 0], [0, 0, -0.1], [0, 0, 0], [0, 0, 0]] },
      { from: 0, to: 1, H: [[0.1, 0, 0.2, 0], [0.05, 0, 0, 0], [0, 0.1, 0, 0]] },
    ],
    dt: 0.001,
    duration: 20,
    lanes: ['intermediate_fast', 'intermediate_ref'],
  };
}

/** The attack drives a state that no output shows in the steady state: an invariant zero at 0 (specification, section 10). */
function undetectable(): SystemDraft {
  const one = subsystem({ A: [[-1, 1], [0, -2]], C: [[0, 1]], D: column(1, 0) }, { signals: { w: [[piece(5, 0, 1, 0, 2)]], d: [], f: [], u: [] } });
  return { subsystems: [one], couplings: [], dt: 0.001, duration: 5, lanes: ['intermediate_ref'] };
}

export function start(name: StartName): SystemDraft {
  if (name === 'pair') return pair();
  if (name === 'undetectable') return undetectable();
  return { subsystems: [emptySubsystem()], couplings: [], dt: 0.001, duration: 10, lanes: ['intermediate_ref'] };
}
