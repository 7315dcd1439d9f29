import { dictionary, type Translation } from '../../../i18n/i18n.svelte';

const en = {
  signed: 'Errors per node',
  signed_note: '{lane}: estimate − truth',
  signed_scale: 'Scale',
  scale_symlog: '± log',
  scale_linear: 'linear',
  signed_of: '{component} error',
  signed_label: 'Error of {component} of every node of {lane} over time, in {unit}; {scale}. Thin: {reference}',
  signed_label_alone: 'Error of {component} of every node of {lane} over time, in {unit}; {scale}',
  signed_symlog_words: 'logarithmic beyond ±{middle}, linear between',
  signed_linear_words: 'linear',
  signed_none: 'Lane {lane} has no estimates of {list}.',
  signed_reference: '{lane}, for comparison: it ignores every sensor',
};

const zh: Translation<typeof en> = {
  signed: '各节点误差',
  signed_note: '{lane}：估计 − 真值',
  signed_scale: '坐标',
  scale_symlog: '± 对数',
  scale_linear: '线性',
  signed_of: '{component} 误差',
  signed_label: '{lane} 各节点 {component} 误差随时间的变化，单位 {unit}；{scale}。细线：{reference}',
  signed_label_alone: '{lane} 各节点 {component} 误差随时间的变化，单位 {unit}；{scale}',
  signed_symlog_words: '±{middle} 以内线性，以外对数',
  signed_linear_words: '线性',
  signed_none: '{lane} 没有 {list} 的估计。',
  signed_reference: '{lane} 作参照：不使用任何传感器',
};

export const t = dictionary('component_errors', en, zh);
