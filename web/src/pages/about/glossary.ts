/// The page's words for the field, in both languages, with the papers' symbols.
import type { Localised } from '../../api/types';

export interface Term {
  term: Localised;
  /** As the papers write it; empty where there is none. */
  symbol: string;
  meaning: Localised;
}

export const glossary: readonly Term[] = [
  {
    term: { en: 'Lane', zh: '通道' },
    symbol: '',
    meaning: {
      en: 'One contender of a run: an estimator with its parameters, and its protection and detector where it has them. All lanes see the same draws.',
      zh: '一次运行中的一个参比方法：估计器及其参数，以及可能带有的隐私保护与检测器。所有通道使用相同的随机抽样。',
    },
  },
  {
    term: { en: 'Scenario', zh: '场景' },
    symbol: '',
    meaning: { en: 'A world, an adversary and a set of lanes, as one JSON document.', zh: '对象与环境、攻击者与一组通道，写成一份 JSON 文档。' },
  },
  {
    term: { en: 'Run', zh: '运行' },
    symbol: '',
    meaning: {
      en: 'A scenario, a seed and a version. The same three give the same numbers, bit for bit.',
      zh: '场景、种子与版本三者确定一次运行；三者相同则结果逐位相同。',
    },
  },
  {
    term: { en: 'Trace', zh: '轨迹数据' },
    symbol: '',
    meaning: { en: 'A recorded or measured input that takes the place of the simulated world.', zh: '替代仿真环境的记录或实测输入。' },
  },
  {
    term: { en: 'Tick', zh: '步' },
    symbol: 'k',
    meaning: { en: 'One step of the run: plant, sensors, attack, exchange, update, metrics. Frame k ends tick k.', zh: '运行的一步：对象、传感器、攻击、交换、更新、指标。第 k 步结束时输出第 k 帧。' },
  },
  {
    term: { en: 'Consensus filtering', zh: '共识滤波' },
    symbol: 'C_i, ε',
    meaning: {
      en: 'Each node filters its own readings and pulls its estimate towards those of its neighbours.',
      zh: '每个节点对自身量测滤波，并使其估计向邻居的估计靠拢。',
    },
  },
  {
    term: { en: 'Innovation', zh: '新息' },
    symbol: 'z − h(x̂)',
    meaning: { en: 'What a reading says beyond what was predicted.', zh: '量测中超出预测的部分。' },
  },
  {
    term: { en: 'Denial of service, DoS', zh: '拒绝服务攻击' },
    symbol: 'φ',
    meaning: { en: 'The attacker blocks a channel: no packet comes, and the receiver knows it. Letter D.', zh: '攻击者阻塞信道：数据包不到达，接收方知晓。以字母 D 表示。' },
  },
  {
    term: { en: 'False data injection, FDI', zh: '虚假数据注入攻击' },
    symbol: 'γ, ξ',
    meaning: { en: 'The attacker adds a bounded vector to what a channel carries. Letter F.', zh: '攻击者在信道所传数据上叠加有界向量。以字母 F 表示。' },
  },
  {
    term: { en: 'Replay attack', zh: '重放攻击' },
    symbol: '',
    meaning: { en: 'The attacker sends again what was recorded earlier. Letter R.', zh: '攻击者重新发送先前录下的数据。以字母 R 表示。' },
  },
  {
    term: { en: 'Eavesdropping', zh: '窃听' },
    symbol: '',
    meaning: { en: 'Someone overhears a channel without changing it. Letter E.', zh: '有人旁听信道而不作改动。以字母 E 表示。' },
  },
  {
    term: { en: 'Error bound', zh: '误差上界' },
    symbol: 'Φ',
    meaning: {
      en: 'The upper bound of the error covariance that the filter carries along. Whether it really is one is what conditions (28) and (29) decide.',
      zh: '滤波器递推的误差协方差上界。它是否真是上界，由条件 (28)、(29) 决定。',
    },
  },
  {
    term: { en: 'Feasibility', zh: '可行性' },
    symbol: '(28), (29)',
    meaning: { en: 'The sufficient conditions of the theorem, checked at every node and tick.', zh: '定理的充分条件，在每个节点、每一步检验。' },
  },
  {
    term: { en: 'Guard', zh: '防护' },
    symbol: 'ρ',
    meaning: {
      en: 'What the filter does where a condition fails: clip, strict, adapt or none.',
      zh: '条件不满足时滤波器的处理方式：clip（截断）、strict（严格）、adapt（自适应）或 none（无）。',
    },
  },
  {
    term: { en: 'RMSE', zh: '均方根误差' },
    symbol: '√(mean e²)',
    meaning: { en: 'Root of the mean square of the position error over nodes and ticks.', zh: '位置误差在各节点、各步上的均方根。' },
  },
  {
    term: { en: 'NEES, NIS', zh: '归一化估计误差平方、归一化新息平方' },
    symbol: 'eᵀP⁻¹e, νᵀS⁻¹ν',
    meaning: {
      en: 'Whether the claimed covariance fits the error made, and the innovation seen. Compared with chi-square bounds.',
      zh: '所声称的协方差是否与实际误差、新息相符；与卡方界比较。',
    },
  },
  {
    term: { en: 'Threshold', zh: '阈值' },
    symbol: '',
    meaning: { en: 'The value of a detector’s statistic above which it raises an alarm.', zh: '检测统计量超过此值时检测器报警。' },
  },
  {
    term: { en: 'Confidentiality index', zh: '保密性指标' },
    symbol: 'CI',
    meaning: {
      en: 'Logarithm of the eavesdropper’s error over the legitimate user’s.',
      zh: '窃听者误差与合法用户误差之比的对数。',
    },
  },
  {
    term: { en: 'Gap', zh: '缺口' },
    symbol: '',
    meaning: { en: 'Ticks whose samples are missing. Drawn hatched, never bridged by a line.', zh: '样本缺失的若干步。以斜线标出，绝不用线连接。' },
  },
];
