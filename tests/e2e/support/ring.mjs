// A ring of eight subsystems: its gains take a while to find, which is what tests of waiting want.
const column = (...values) => values.map((value) => [value]);
const subsystem = {
  A: [[-1, 0, 0, 0], [1, -2, 0, 0], [1, 0, -1, 1.5], [0, 2, 0, -1]],
  C: [[1, 0, 0, 0], [0, 1, 0.2, 0], [1, 1, 2, 0]],
  D: column(1, 0, 1, 0),
  Dd: column(-1, 0, 1, 0.5),
  G: column(1, 0, 1),
  phi: 'none',
};
const H = [[-0.05, 0, 0, 0], [0, 0, -0.1, 0], [0, 0, 0, 0], [0, 0, 0, 0]];

/** A scenario with as many lanes as asked for, no two of which have the same problem. */
export function ring(lanes) {
  const ids = Array.from({ length: 8 }, (_, i) => String(i + 1));
  const of = (make) => Object.fromEntries(ids.map((id, i) => [id, make(i)]));
  return {
    vigil: 1,
    id: 'ring',
    title: { en: 'A ring', zh: '环' },
    family: 'observer',
    time: { dt: 0.001, steps: 500 },
    plant: { type: 'interconnected', params: { subsystems: of(() => subsystem), couplings: Object.fromEntries(ids.flatMap((id, i) => [[`${id}-${ids[(i + 1) % 8]}`, H], [`${ids[(i + 1) % 8]}-${id}`, H]])) } },
    nodes: of((i) => ({ sensor: { type: 'subsystem', params: { number: i + 1 } } })),
    network: { graph: 'none' },
    noise: { Q: 0, P0: 0 },
    initial: { truth: ids.flatMap(() => [0.1, 0, 0, 0]) },
    lanes: Object.fromEntries(Array.from({ length: lanes }, (_, i) => [`lane_${i + 1}`, { method: 'intermediate_observer', params: { cnu: 1e-5 * (1 + i / 100) } }])),
  };
}
