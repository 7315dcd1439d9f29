import { dictionary, type Translation } from '../../../i18n/i18n.svelte';

const en = {
  title: 'Errors and their density',
  empty: 'Lane {lane} estimates fewer than two components of the state.',
  note: 'estimate − truth; density from tick {from} on',
  other: 'Compared with',
  other_none: 'nothing',
  ticks: 'Ticks in the density',
  calm: 'not attacked',
  all: 'all',
  calm_why: 'Under a replay every estimator follows the record: its error then says nothing of the estimator. The paper’s figures use runs without an attack.',
  component: 'error of {component}',
  time_label: 'Error of {component} over time, {lanes}',
  density_label: 'Density of the error of {component}: {figures}',
  figures_label: '{lane} mean {mean}, standard deviation {deviation}, {n} ticks',
  reading: 'Reading the recorded errors',
  failed: 'The recorded errors could not be read.',
  without: 'Without an attack',
  rmse: 'RMSE',
  peak: 'peak',
  without_why: 'From the lane’s twin on the same draws that nobody attacks: root mean square over the components and the largest error, from tick {from} on.',
};

const zh: Translation<typeof en> = {
  title: '误差及其密度',
  empty: '{lane} 估计的状态分量不足两个。',
  note: '估计 − 真值；密度自第 {from} 步起',
  other: '对照',
  other_none: '无',
  ticks: '计入密度的步',
  calm: '未受攻击',
  all: '全部',
  calm_why: '重放之下每个估计器都跟随记录，此时的误差说明不了估计器的好坏。论文的图取自无攻击的运行。',
  component: '{component} 误差',
  time_label: '{component} 误差随时间的变化，{lanes}',
  density_label: '{component} 误差的密度：{figures}',
  figures_label: '{lane} 均值 {mean}，标准差 {deviation}，{n} 步',
  reading: '正在读取记录的误差',
  failed: '未能读取记录的误差。',
  without: '无攻击时',
  rmse: 'RMSE',
  peak: '峰值',
  without_why: '取自同样噪声下未受攻击的孪生通道：各分量的均方根与最大误差，自第 {from} 步起。',
};

export const t = dictionary('density', en, zh);
