// A made-up run shaped like the consensus family's: for looking at the page without a server. Its numbers mean nothing.
const edges = [[1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [6, 7], [7, 8], [8, 1], [3, 8], [4, 7]];
const cameras = [[60, 60], [60, 180], [120, 180], [180, 180], [240, 180], [240, 160], [180, 120], [120, 120]];
export const lanes = ['consensus', 'clean', 'drop', 'naive_hold', 'naive_zero', 'isolated', 'centralized'];
const level = { consensus: 2.6, clean: 2.4, drop: 2.9, naive_hold: 4.7, naive_zero: 38, isolated: 8, centralized: 0.13 };

export const world = {
  nodes: cameras.map((position, i) => ({ id: String(i + 1), position })),
  links: edges.flatMap(([a, b]) => [[a, b], [b, a]]).map(([a, b]) => ({ id: `${a}-${b}`, from: String(a), to: String(b) })),
  lanes: lanes.map((id) => ({ id, method: id === 'isolated' ? 'isolated_ekf' : id === 'centralized' ? 'centralized_ekf' : 'consensus_ekf', adversary: id !== 'clean' })),
  state: [{ name: 'x', unit: 'cm' }, { name: 'y', unit: 'cm' }, { name: 'theta', unit: 'deg' }],
};

const nodesOf = (lane) => (lane === 'centralized' ? ['fused'] : world.nodes.map((node) => node.id));
const filters = ['consensus', 'clean', 'drop', 'naive_hold', 'naive_zero'];

export const signals = [];
const add = (name, unit = '', kind = 'scalar', extra = {}) => signals.push({ id: signals.length, name, unit, kind, ...extra });
for (const { name, unit } of world.state) add(`truth.${name}`, unit);
add('input.sR', 'cm');
add('input.sL', 'cm');
for (const link of world.links) add(`link.${link.id}.state`, '', 'category', { link: link.id, labels: { 0: 'clean', 1: 'DoS', 2: 'FDI', 3: 'replay' } });
for (const lane of lanes) {
  for (const node of nodesOf(lane)) {
    const of = (rest, unit, kind) => add(`lane.${lane}.${node}.${rest}`, unit, kind, { lane, node });
    for (const { name, unit } of world.state) of(`estimate.${name}`, unit);
    of('error', 'cm');
    of('bound', 'cm²');
    if (filters.includes(lane)) {
      of('feasible28', '', 'bool');
      of('feasible29', '', 'bool');
      of('lambda_max');
      of('lost');
    }
  }
  add(`lane.${lane}.rmse`, 'cm', 'scalar', { lane });
  add(`lane.${lane}.spread`, 'cm', 'scalar', { lane });
}

// A draw that depends on its address alone.
export function draw(k, stream) {
  let h = (k * 2654435761 + stream * 40503 + 12345) >>> 0;
  h = Math.imul(h ^ (h >>> 15), 2246822507) >>> 0;
  h = Math.imul(h ^ (h >>> 13), 3266489909) >>> 0;
  return ((h ^ (h >>> 16)) >>> 0) / 4294967296;
}
const smooth = (k, stream, span) => {
  const i = Math.floor(k / span);
  const f = k / span - i;
  const s = f * f * (3 - 2 * f);
  return (draw(i, stream) * (1 - s) + draw(i + 1, stream) * s) * 2 - 1;
};

export function row(k) {
  const values = new Map();
  const angle = (k * 9.167 * Math.PI) / 180;
  const truth = { x: 150 + 50 * Math.sin(angle) + 3 * smooth(k, 1, 20), y: 120 - 50 * Math.cos(angle) + 3 * smooth(k, 2, 20), theta: 9.167 * k };
  for (const [name, value] of Object.entries(truth)) values.set(`truth.${name}`, value);
  values.set('input.sR', k ? 10.4 : null);
  values.set('input.sL', k ? 5.6 : null);
  const lost = {};
  world.links.forEach((link, i) => {
    const u = draw(k, 100 + i);
    const state = k === 0 ? 0 : u < 0.2 ? 1 : u < 0.4 ? 2 : 0;
    if (state === 1) lost[link.to] = (lost[link.to] ?? 0) + 1;
    values.set(`link.${link.id}.state`, k ? state : null);
  });
  lanes.forEach((lane, l) => {
    let sum = 0;
    const nodes = nodesOf(lane);
    nodes.forEach((node, n) => {
      const size = level[lane] * (0.5 + 0.7 * Math.abs(smooth(k, 1000 + 50 * l + n, 15)));
      const way = smooth(k, 5000 + 50 * l + n, 30) * Math.PI;
      const at = (rest) => `lane.${lane}.${node}.${rest}`;
      values.set(at('estimate.x'), truth.x + size * Math.cos(way));
      values.set(at('estimate.y'), truth.y + size * Math.sin(way));
      values.set(at('estimate.theta'), truth.theta + smooth(k, 9000 + n, 10) * 2);
      values.set(at('error'), size);
      values.set(at('bound'), 240 + 80 * smooth(k, 7000 + 50 * l + n, 6));
      values.set(at('feasible28'), k < 2 || draw(k, 300 + n) < 0.1 ? 1 : 0);
      values.set(at('feasible29'), draw(k, 400 + n) < 0.7 ? 1 : 0);
      values.set(at('lambda_max'), 12 + 6 * draw(k, 500 + n));
      values.set(at('lost'), lost[node] ?? 0);
      sum += size * size;
    });
    values.set(`lane.${lane}.rmse`, Math.sqrt(sum / nodes.length));
    values.set(`lane.${lane}.spread`, level[lane]);
  });
  return signals.map((signal) => {
    const value = values.get(signal.name);
    return value === undefined || value === null ? null : Number(value.toPrecision(6));
  });
}

export function metrics(k) {
  const list = [];
  for (const lane of lanes) {
    list.push({ lane, node: null, name: 'rmse_position', variant: null, value: level[lane] * (1 + 0.02 * Math.sin(k / 50)) });
    list.push({ lane, node: null, name: 'first_infeasible_step', variant: null, value: filters.includes(lane) ? 2 : null });
    list.push({ lane, node: null, name: 'bound_guaranteed', variant: null, value: ['consensus', 'clean', 'drop'].includes(lane) ? false : null });
  }
  return list;
}
