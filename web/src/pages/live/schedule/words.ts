import { dictionary, type Translation } from '../../../i18n/i18n.svelte';

const en = {
  schedule: 'Sensors under attack',
  schedule_note: 'one cell a tick',
  schedule_several: '{n} ticks a cell: zoom in to see which attack',
  schedule_label: 'Attacks on the sensor of every node over time',
  schedule_empty: 'This run has no sensors whose state is told.',
  schedule_now: 'now: {list}',
  schedule_then: 'at k = {k}: {list}',
  schedule_nobody: 'none',
  schedule_column: 'sensor {id}',
  band: 'sensors attacked',
};

const zh: Translation<typeof en> = {
  schedule: '受攻击的传感器',
  schedule_note: '每格一步',
  schedule_several: '每格 {n} 步：放大可见是哪种攻击',
  schedule_label: '各节点传感器所受攻击随时间的变化',
  schedule_empty: '该运行没有给出传感器状态。',
  schedule_now: '当前：{list}',
  schedule_then: 'k = {k} 时：{list}',
  schedule_nobody: '无',
  schedule_column: '传感器 {id}',
  band: '传感器受攻击',
};

export const t = dictionary('schedule', en, zh);
