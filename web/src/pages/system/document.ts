/// A described system as a scenario's document, and back: where what is wrong with it has its place.
import { isObject, type Json, type JsonObject } from '../../form/json';
import { emptySubsystem, matrixNames, shapes, signalKinds, withSizes, type Cells, type MatrixName, type ScalarName, type SignalKind, type Sizes, type SubsystemDraft, type SystemDraft } from './draft';
import { laneChoices } from './lanes';

export const subsystemPointer = (index: number): string => `/plant/params/subsystems/${index + 1}`;
export const matrixPointer = (index: number, name: string): string => `${subsystemPointer(index)}/${name}`;
export const couplingKey = ({ from, to }: { from: number; to: number }): string => `${from + 1}-${to + 1}`;
export const couplingPointer = (coupling: { from: number; to: number }): string => `/plant/params/couplings/${couplingKey(coupling)}`;

/** Where a signal stands in the document: attacks are the adversary's, the others belong to the node. */
export function signalPointer(index: number, kind: SignalKind, channel: number): string {
  return kind === 'w' ? `/adversary/${attackName(index, channel)}` : `/nodes/${index + 1}/signals/${kind}${channel + 1}`;
}

export const attackName = (index: number, channel: number): string => `w${index + 1}_${channel + 1}`;

const isQuiet = (pieces: Cells): boolean => pieces.every((piece) => piece.slice(1).every((cell) => cell === 0));

function subsystemDocument({ sizes, matrices, scalars, phi }: SubsystemDraft): JsonObject {
  const has = (name: MatrixName): boolean => sizes[shapes[name][0]] > 0 && sizes[shapes[name][1]] > 0;
  const own: JsonObject = Object.fromEntries(matrixNames.filter(has).map((name) => [name, matrices[name]]));
  own.alpha = scalars.alpha;
  own.tau = scalars.tau;
  own.phi = sizes.r > 0 ? phi : 'none';
  return own;
}

function signalsDocument(subsystem: SubsystemDraft): JsonObject {
  const result: JsonObject = {};
  for (const kind of ['d', 'f', 'u'] as const) {
    subsystem.signals[kind].forEach((pieces, i) => {
      if (!isQuiet(pieces)) result[`${kind}${i + 1}`] = { type: 'waveform', params: { pieces } };
    });
  }
  return result;
}

function adversary(system: SystemDraft): JsonObject {
  const result: JsonObject = {};
  system.subsystems.forEach((subsystem, index) =>
    subsystem.signals.w.forEach((pieces, channel) => {
      if (!isQuiet(pieces)) result[attackName(index, channel)] = { type: 'waveform', on: [`actuator:${index + 1}.w${channel + 1}`], params: { pieces } };
    }),
  );
  return result;
}

/** What an observer is told of the subsystems: varsigma of each, and kappa where every nonlinear one has it. */
function told({ subsystems }: SystemDraft): JsonObject {
  const nonlinear = subsystems.filter(({ sizes }) => sizes.r > 0);
  const fixed = nonlinear.length > 0 && nonlinear.every(({ scalars }) => scalars.kappa !== null);
  // One that has no nonlinearity has a place in the list all the same.
  return { varsigma: subsystems.map(({ scalars }) => scalars.varsigma), ...(fixed ? { kappa: subsystems.map(({ scalars, sizes }) => (sizes.r > 0 ? scalars.kappa : 1)) } : {}) };
}

function laneDocument(system: SystemDraft, lane: string): JsonObject {
  const { method, params } = laneChoices[lane]!;
  return { method, params: method === 'intermediate_observer' ? { ...params, ...told(system) } : params };
}

export function stepsOf({ dt, duration }: SystemDraft): number {
  return typeof dt === 'number' && typeof duration === 'number' && dt > 0 ? Math.max(1, Math.round(duration / dt)) : 1;
}

/** Seconds from which on the figures count: what comes before is the observers' settling. */
export function countedFrom({ duration }: SystemDraft): number {
  return typeof duration === 'number' ? Math.min(2, duration / 4) : 0;
}

function firstCounted(system: SystemDraft): number {
  return typeof system.dt === 'number' && system.dt > 0 ? Math.round(countedFrom(system) / system.dt) + 1 : 1;
}

export function documentOf(system: SystemDraft, title = ''): JsonObject {
  const numbered = <T extends Json>(of: (subsystem: SubsystemDraft, index: number) => T): JsonObject => Object.fromEntries(system.subsystems.map((subsystem, i) => [String(i + 1), of(subsystem, i)]));
  const words = title || `${system.subsystems.length} × x′ = Ax + …`;
  return {
    vigil: 1,
    id: 'own-system',
    title: { en: words, zh: words },
    family: 'observer',
    time: { dt: system.dt, steps: stepsOf(system) },
    plant: { type: 'interconnected', params: { subsystems: numbered(subsystemDocument), couplings: Object.fromEntries(system.couplings.map((one) => [couplingKey(one), one.H])) } },
    nodes: numbered((subsystem, i) => {
      const signals = signalsDocument(subsystem);
      return { sensor: { type: 'subsystem', params: { number: i + 1 } }, ...(Object.keys(signals).length ? { signals } : {}) };
    }),
    network: { graph: 'none' },
    noise: { Q: 0, P0: 0 },
    initial: { truth: system.subsystems.flatMap((subsystem) => subsystem.x0) },
    adversary: adversary(system),
    lanes: Object.fromEntries(system.lanes.filter((lane) => laneChoices[lane]).map((lane) => [lane, laneDocument(system, lane)])),
    metrics: { window: { from: firstCounted(system) } },
  };
}

const cellsOf = (value: Json | undefined): Cells => (Array.isArray(value) ? value.map((row) => (Array.isArray(row) ? row : [])) : []);
const objectOf = (value: Json | undefined): JsonObject => (value !== undefined && isObject(value) ? value : {});

/** The draft of a document that such a form has made; null where it describes no system of one's own. */
export function draftOf(document: JsonObject): SystemDraft | null {
  const plant = objectOf(document.plant);
  if (plant.type !== 'interconnected') return null;
  const params = objectOf(plant.params);
  const entries = Object.entries(objectOf(params.subsystems));
  if (!entries.length) return null;
  const ids = entries.map(([id]) => id);
  const x0 = objectOf(document.initial).truth;
  let offset = 0;
  const lane = observerOf(document);
  const subsystems = entries.map(([id, value], index) => {
    const own = draftSubsystem(objectOf(value), objectOf(objectOf(objectOf(document.nodes)[id]).signals), objectOf(document.adversary), index, id);
    const x = Array.isArray(x0) ? x0.slice(offset, offset + own.sizes.n) : [];
    offset += own.sizes.n;
    return withSizes({ ...own, scalars: { ...own.scalars, varsigma: entryOf(lane.varsigma, index) ?? 1, kappa: own.sizes.r > 0 ? entryOf(lane.kappa, index) : null }, x0: x }, own.sizes);
  });
  const couplings = Object.entries(objectOf(params.couplings)).flatMap(([key, H]) => {
    const [from, to] = ids.flatMap((a, i) => ids.flatMap((b, j) => (key === `${a}-${b}` ? [[i, j] as const] : [])))[0] ?? [-1, -1];
    return from < 0 ? [] : [{ from, to, H: cellsOf(H) }];
  });
  const time = objectOf(document.time);
  const dt = typeof time.dt === 'number' ? time.dt : 0.001;
  const lanes = Object.keys(objectOf(document.lanes)).filter((lane) => laneChoices[lane]);
  return { subsystems, couplings, dt, duration: typeof time.steps === 'number' ? Number((time.steps * dt).toPrecision(12)) : 10, lanes };
}

/** What the first intermediate observer of a document is set to. */
function observerOf(document: JsonObject): JsonObject {
  const lanes = Object.values(objectOf(document.lanes)).map(objectOf);
  return objectOf(lanes.find(({ method }) => method === 'intermediate_observer')?.params);
}

const entryOf = (list: Json | undefined, index: number): Json => (Array.isArray(list) ? (list[index] ?? null) : null);

function draftSubsystem(own: JsonObject, signals: JsonObject, attacks: JsonObject, index: number, id: string): SubsystemDraft {
  const matrices = Object.fromEntries(matrixNames.map((name) => [name, cellsOf(own[name])])) as Record<MatrixName, Cells>;
  const width = (name: MatrixName): number => matrices[name][0]?.length ?? 0;
  const sizes: Sizes = { n: matrices.A.length, m: width('B'), p: matrices.C.length, q: width('D'), dd: width('Dd'), g: width('G'), r: width('F') };
  const blank = emptySubsystem(sizes);
  const scalars: Record<ScalarName, Json> = { ...blank.scalars, alpha: own.alpha ?? 1, tau: own.tau ?? 0 };
  const piecesOf = (value: Json | undefined): Cells => cellsOf(objectOf(objectOf(value).params).pieces);
  const read = (kind: SignalKind, channel: number): Cells => {
    const found = kind === 'w' ? piecesOf(attackOn(attacks, `actuator:${id}.w${channel + 1}`) ?? attacks[attackName(index, channel)]) : piecesOf(signals[`${kind}${channel + 1}`]);
    return found.length ? found : blank.signals[kind][channel]!;
  };
  const drawn = Object.fromEntries(signalKinds.map((kind) => [kind, blank.signals[kind].map((_, channel) => read(kind, channel))])) as Record<SignalKind, Cells[]>;
  return { sizes, matrices, scalars, phi: typeof own.phi === 'string' ? own.phi : 'none', x0: [], signals: drawn };
}

function attackOn(attacks: JsonObject, place: string): Json | undefined {
  return Object.values(attacks).find((attack) => {
    const on = objectOf(attack).on;
    return Array.isArray(on) && on.includes(place);
  });
}
