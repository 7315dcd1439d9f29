import { dictionary, type Translation } from '../../../i18n/i18n.svelte';

const en = {
  title: 'State and its set',
  empty: 'Lane {lane} estimates fewer than two components of the state.',
  truth: 'truth',
  estimate: 'estimate',
  bounded: 'ellipsoid M',
  bounded_why: 'Shape matrix M of the bounded part of the error. Where the noise is bounded only and nothing is attacked, the truth is always inside.',
  random: '2σ of Q',
  random_why: 'Two standard deviations of the random part of the error, covariance Q.',
  none: '{lane} publishes neither M nor Q.',
  plane_label: 'Plane of {x} and {y} at tick {k}: truth and estimate of {lane} with their last {tail} ticks, the ellipsoid M and two standard deviations of Q about the estimate',
  band_label: '{component} over time: truth, estimate of {lane} and the band of its projections, √M plus 2√Q',
  column_truth: '{component} true',
  column_estimate: '{component} estimate',
};

const zh: Translation<typeof en> = {
  title: '状态及其集合',
  empty: '{lane} 估计的状态分量不足两个。',
  truth: '真值',
  estimate: '估计',
  bounded: '椭球 M',
  bounded_why: '误差有界部分的形状矩阵 M。噪声仅为有界且无攻击时，真值必在其中。',
  random: 'Q 的 2σ',
  random_why: '误差随机部分（协方差 Q）的两倍标准差。',
  none: '{lane} 不发布 M 与 Q。',
  plane_label: '第 {k} 步 {x}–{y} 平面：真值与 {lane} 的估计及其最近 {tail} 步，估计周围的椭球 M 与 Q 的两倍标准差',
  band_label: '{component} 随时间的变化：真值、{lane} 的估计及其投影带 √M 加 2√Q',
  column_truth: '{component} 真值',
  column_estimate: '{component} 估计',
};

export const t = dictionary('ellipsoid', en, zh);
