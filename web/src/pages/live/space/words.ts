import { dictionary, type Translation } from '../../../i18n/i18n.svelte';

const en = {
  space: 'Trajectories',
  space_sight: 'Seen',
  sight_space: 'space',
  space_truth: 'truth',
  space_nodes: 'Nodes',
  space_node: 'Node {id}: bring to the front',
  space_attacked: 'its sensor is attacked: {letter}',
  space_label: 'The true way and the ways of the nodes of {lane} up to tick {k}, seen {sight}. {attacked}',
  space_label_plane: 'in the plane of {sight}',
  space_label_space: 'in space; arrow keys or dragging turn it, Home or a double click turn it back',
  space_nobody: 'No sensor is attacked.',
  space_attacks: 'Attacked sensors: {list}.',
  space_empty: 'This run has no space: its scenario names no three position components.',
  space_tail: 'the last {n} ticks',
  space_no_lane: 'Lane {lane} sends no position in space.',
};

const zh: Translation<typeof en> = {
  space: '轨迹',
  space_sight: '视角',
  sight_space: '三维',
  space_truth: '真值',
  space_nodes: '节点',
  space_node: '节点 {id}：置于前方',
  space_attacked: '其传感器受攻击：{letter}',
  space_label: '截至第 {k} 步的真实轨迹与 {lane} 各节点的估计轨迹，{sight}。{attacked}',
  space_label_plane: '{sight} 平面视图',
  space_label_space: '三维视图；方向键或拖动可旋转，Home 键或双击复位',
  space_nobody: '没有传感器受攻击。',
  space_attacks: '受攻击的传感器：{list}。',
  space_empty: '该运行没有三维空间：场景未指明三个位置分量。',
  space_tail: '最近 {n} 步',
  space_no_lane: '{lane} 不输出三维位置。',
};

export const t = dictionary('space', en, zh);
