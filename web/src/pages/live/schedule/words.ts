import { dictionary, type Translation } from '../../../i18n/i18n.svelte';

const en = {
  schedule: 'Sensors under attack',
  schedule_label: 'Attacks on the sensor of every node over time',
  schedule_empty: 'This run has no sensors whose state is told.',
  schedule_now: 'now: {list}',
  schedule_then: 'at k = {k}: {list}',
  schedule_nobody: 'none',
  schedule_column: 'sensor {id}',
  short_dos: 'jammed',
  short_fdi: 'falsified',
  short_replay: 'replayed',
  short_i: 'type I',
  short_ii: 'type II',
  short_r: 'range',
};

const zh: Translation<typeof en> = {
  schedule: '受攻击的传感器',
  schedule_label: '各节点传感器所受攻击随时间的变化',
  schedule_empty: '该运行没有给出传感器状态。',
  schedule_now: '当前：{list}',
  schedule_then: 'k = {k} 时：{list}',
  schedule_nobody: '无',
  schedule_column: '传感器 {id}',
  short_dos: '阻塞',
  short_fdi: '篡改',
  short_replay: '重放',
  short_i: 'I 类',
  short_ii: 'II 类',
  short_r: '仅距离',
};

export const t = dictionary('schedule', en, zh);
