import { dictionary, type Translation } from '../../i18n/i18n.svelte';

const en = {
  designing: 'Gains are being computed',
  designing_why: 'The run starts by itself when every lane has gains whose certificate holds.',
  lanes: 'Gains of every lane',
  lane: 'Lane',
  state: 'State',
  time: 'Time',
  queued: 'waiting',
  solving: 'solving',
  done: 'certified',
  refused: 'refused',
  of: '{seconds} s of at most {limit} s',
  spent: '{seconds} s',
  waited: '{seconds} so far.',
  stop: 'Stop the run',
};

const zh: Translation<typeof en> = {
  designing: '正在计算增益',
  designing_why: '各方法都有了证书成立的增益之后，运行会自行开始。',
  lanes: '各方法的增益',
  lane: '方法',
  state: '状态',
  time: '用时',
  queued: '等待',
  solving: '求解中',
  done: '已有证书',
  refused: '被拒绝',
  of: '{seconds} s，上限 {limit} s',
  spent: '{seconds} s',
  waited: '已用 {seconds}。',
  stop: '停止运行',
};

export const t = dictionary('designing', en, zh);
