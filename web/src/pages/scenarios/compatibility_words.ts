import { dictionary, type Translation } from '../../i18n/i18n.svelte';

const en = {
  title: 'Attacks and lanes',
  intro: 'Which lane meets which attack on which channel. The word says what it reaches first; a number is the reason below why it does not.',
  all: 'Also attacks that act nowhere here',
  attack: 'Attack',
  channel: 'On',
  channel_link: 'links',
  channel_sensor: 'sensors',
  channel_actuator: 'actuators',
  meets_estimate: 'estimate',
  meets_detector: 'detector',
  meets_plant: 'plant',
  meets_messages: 'overheard',
  reasons: 'Reasons',
  add: 'Add',
  add_label: 'Add {attack} on {place} to the scenario',
  added: '{attack} is in the scenario as {id}.',
  busy: 'Asking the server',
};

const zh: Translation<typeof en> = {
  title: '攻击与通道',
  intro: '各通道会受到哪种信道上的哪种攻击。文字表示攻击首先影响之处；数字为下方所列的不受影响的原因。',
  all: '也显示在此不起作用的攻击',
  attack: '攻击',
  channel: '作用于',
  channel_link: '链路',
  channel_sensor: '传感器',
  channel_actuator: '执行器',
  meets_estimate: '估计',
  meets_detector: '检测器',
  meets_plant: '对象',
  meets_messages: '被窃听',
  reasons: '原因',
  add: '添加',
  add_label: '将 {place} 上的 {attack} 加入场景',
  added: '{attack} 已加入场景，名为 {id}。',
  busy: '正在询问服务器',
};

export const t = dictionary('compatibility', en, zh);
