import { dictionary, type Translation } from '../../../i18n/i18n.svelte';

const en = {
  table2: 'Table 2, live',
  table2_note: 'mean square error of px, m²',
  table2_caption: 'Mean square error of px of every lane and node, {span}; the least of a column is bold',
  table2_span: 'Span',
  span_whole: 'whole run',
  span_0_9s: '0–9 s',
  table2_lane: 'Lane',
  table2_node: 'node {id}',
  table2_choose: 'Show lane {lane} on every panel',
  table2_this_run: 'this run, seed {seed}',
  table2_source: 'printed in the source',
  table2_source_why: 'As the paper prints them in its Table 2. Its stations, its network and its draws are not known: orders of magnitude can be compared, single numbers cannot.',
  table2_source_whole: 'The source prints the whole run only.',
  table2_reference: 'ignores every sensor',
  table2_lesson: 'The whole-run mean alone proves nothing: pred ignores every sensor and needs only the known start and the stable loop.',
  table2_won: 'Here it is the best at {n} of {m} nodes.',
  table2_late: 'Of the whole-run error of {lane} at node {node}, {share} % falls after 9 s.',
  table2_copy: 'Copy as CSV',
  table2_copied: 'The table is on the clipboard.',
  table2_empty: 'This run has no mean square error of px.',
};

const zh: Translation<typeof en> = {
  table2: '表 2（实时）',
  table2_note: 'px 的均方误差，m²',
  table2_caption: '各方法各节点的 px 均方误差，{span}；每列最小者加粗',
  table2_span: '时段',
  span_whole: '全程',
  span_0_9s: '0–9 s',
  table2_lane: '方法',
  table2_node: '节点 {id}',
  table2_choose: '在所有面板上显示 {lane}',
  table2_this_run: '本次运行，种子 {seed}',
  table2_source: '原文所印',
  table2_source_why: '论文表 2 所印数值。其测站位置、网络与随机数均未给出：只能比较量级，不能逐个比较。',
  table2_source_whole: '原文只给出全程数值。',
  table2_reference: '不使用任何传感器',
  table2_lesson: '仅凭全程均方误差说明不了什么：pred 不使用任何传感器，只需已知初值与稳定的闭环。',
  table2_won: '此处它在 {m} 个节点中的 {n} 个上最优。',
  table2_late: '{lane} 在节点 {node} 的全程误差中，{share} % 出现在 9 s 之后。',
  table2_copy: '复制为 CSV',
  table2_copied: '表格已复制到剪贴板。',
  table2_empty: '该运行没有 px 均方误差。',
};

export const t = dictionary('sparse_table', en, zh);
