/// A system of one's own while it is described: sizes, matrices, couplings, signals. Cells may still be no numbers.
import type { Json } from '../../form/json';

/** A matrix by rows; a cell that is no number yet is a text. */
export type Cells = Json[][];

/** Letters of the sizes: states, inputs, outputs, attacks, disturbances, faults, nonlinearities. */
export const sizeNames = ['n', 'm', 'p', 'q', 'dd', 'g', 'r'] as const;
export type SizeName = (typeof sizeNames)[number];
export type Sizes = Record<SizeName, number>;

export const matrixNames = ['A', 'B', 'C', 'D', 'Dd', 'F', 'G'] as const;
export type MatrixName = (typeof matrixNames)[number];

/** Which sizes the rows and columns of each matrix have. */
export const shapes: Readonly<Record<MatrixName, readonly [SizeName, SizeName]>> = {
  A: ['n', 'n'],
  B: ['n', 'm'],
  C: ['p', 'n'],
  D: ['n', 'q'],
  Dd: ['n', 'dd'],
  F: ['n', 'r'],
  G: ['p', 'g'],
};

/** The signals that drive a subsystem, and the size that says how many there are of each. */
export const signalKinds = ['w', 'd', 'f', 'u'] as const;
export type SignalKind = (typeof signalKinds)[number];
export const signalSizes: Readonly<Record<SignalKind, SizeName>> = { w: 'q', d: 'dd', f: 'g', u: 'm' };

/** until, offset, slope, sine, cosine, rate, phase: until in s, rate in rad/s, phase in rad. */
export const pieceColumns = ['until', 'offset', 'slope', 'sine', 'cosine', 'rate', 'phase'] as const;

export const nonlinearities = ['none', 'sine', 'tanh', 'sine_last'] as const;

/** The last two are the lanes' to know, one a subsystem. */
export const scalarNames = ['alpha', 'tau', 'varsigma', 'kappa'] as const;
export type ScalarName = (typeof scalarNames)[number];

export interface SubsystemDraft {
  sizes: Sizes;
  matrices: Record<MatrixName, Cells>;
  /** kappa null: free, found with the gains. */
  scalars: Record<ScalarName, Json>;
  phi: string;
  x0: Json[];
  /** Pieces of every signal of each kind. */
  signals: Record<SignalKind, Cells[]>;
}

export interface CouplingDraft {
  from: number;
  to: number;
  H: Cells;
}

export interface SystemDraft {
  subsystems: SubsystemDraft[];
  couplings: CouplingDraft[];
  /** s */
  dt: Json;
  duration: Json;
  lanes: string[];
}

export const mostSubsystems = 8;
export const mostStates = 12;

export function resized(cells: Cells, rows: number, columns: number): Cells {
  return Array.from({ length: rows }, (_, i) => Array.from({ length: columns }, (__, j) => cells[i]?.[j] ?? 0));
}

const quiet = (): Cells => [[0, 0, 0, 0, 0, 0, 0]];

export function emptySubsystem(sizes: Partial<Sizes> = {}): SubsystemDraft {
  const all: Sizes = { n: 2, m: 0, p: 2, q: 1, dd: 0, g: 0, r: 0, ...sizes };
  const matrices = Object.fromEntries(matrixNames.map((name) => [name, []])) as unknown as Record<MatrixName, Cells>;
  return withSizes({ sizes: all, matrices, scalars: { alpha: 1, tau: 0, varsigma: 1, kappa: null }, phi: 'none', x0: [], signals: { w: [], d: [], f: [], u: [] } }, all);
}

/** The subsystem with other sizes: what it has of every matrix and signal stays, the rest is zero. */
export function withSizes(subsystem: SubsystemDraft, sizes: Sizes): SubsystemDraft {
  const matrices = Object.fromEntries(matrixNames.map((name) => [name, resized(subsystem.matrices[name], sizes[shapes[name][0]], sizes[shapes[name][1]])])) as unknown as Record<MatrixName, Cells>;
  const signals = Object.fromEntries(signalKinds.map((kind) => [kind, Array.from({ length: sizes[signalSizes[kind]] }, (_, i) => subsystem.signals[kind][i] ?? quiet())])) as unknown as Record<SignalKind, Cells[]>;
  return { ...subsystem, sizes, matrices, signals, x0: Array.from({ length: sizes.n }, (_, i) => subsystem.x0[i] ?? 0) };
}

function replaced(system: SystemDraft, index: number, subsystem: SubsystemDraft): SystemDraft {
  return fitted({ ...system, subsystems: system.subsystems.map((one, i) => (i === index ? subsystem : one)) });
}

/** Couplings as large as the subsystems that they join; those of subsystems that are gone are gone, too. */
function fitted(system: SystemDraft): SystemDraft {
  const size = (index: number): number => system.subsystems[index]?.sizes.n ?? 0;
  const couplings = system.couplings.filter(({ from, to }) => size(from) && size(to)).map((one) => ({ ...one, H: resized(one.H, size(one.to), size(one.from)) }));
  return { ...system, couplings };
}

export function setSubsystem(system: SystemDraft, index: number, change: Partial<SubsystemDraft>): SystemDraft {
  return replaced(system, index, { ...system.subsystems[index]!, ...change });
}

export function setSizes(system: SystemDraft, index: number, sizes: Partial<Sizes>): SystemDraft {
  const own = system.subsystems[index]!;
  return replaced(system, index, withSizes(own, { ...own.sizes, ...sizes }));
}

/** A matrix as typed or pasted: where it is larger than the subsystem, the subsystem grows with it. */
export function setMatrix(system: SystemDraft, index: number, name: MatrixName, cells: Cells): SystemDraft {
  const own = system.subsystems[index]!;
  const [rows, columns] = shapes[name];
  const grown = { ...own.sizes };
  const height = Math.min(mostStates, cells.length);
  const width = Math.min(mostStates, Math.max(0, ...cells.map((row) => row.length)));
  // A square matrix has one size only.
  if (rows === columns) grown[rows] = Math.max(height, width);
  else [grown[rows], grown[columns]] = [height, width];
  return replaced(system, index, withSizes({ ...own, matrices: { ...own.matrices, [name]: cells } }, grown));
}

export function setCount(system: SystemDraft, count: number): SystemDraft {
  const subsystems = Array.from({ length: Math.min(mostSubsystems, Math.max(1, count)) }, (_, i) => system.subsystems[i] ?? emptySubsystem());
  return fitted({ ...system, subsystems });
}

export function addCoupling(system: SystemDraft, from: number, to: number, both: boolean): SystemDraft {
  const wanted = [{ from, to }, ...(both ? [{ from: to, to: from }] : [])].filter((one) => one.from !== one.to && !system.couplings.some((other) => other.from === one.from && other.to === one.to));
  return fitted({ ...system, couplings: [...system.couplings, ...wanted.map((one) => ({ ...one, H: [] }))] });
}

export function removeCoupling(system: SystemDraft, from: number, to: number): SystemDraft {
  return { ...system, couplings: system.couplings.filter((one) => one.from !== from || one.to !== to) };
}
