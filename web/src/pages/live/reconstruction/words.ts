import { dictionary, type Translation } from '../../../i18n/i18n.svelte';

const en = {
  title: 'Reconstructed attack',
  empty: 'No lane of this run reconstructs attacks.',
  node: 'Node',
  other_lane: '{chosen} reconstructs nothing; shown is {lane}',
  truth: 'true',
  found: 'found',
  hit: 'hit',
  marks: 'Hit: an entry is found where there is one, whatever its value. Miss: none is found. False: one is found where there is none.',
  miss: 'miss',
  false_entry: 'false',
  note: 'last {n} ticks',
  note_modulo: 'angles modulo a turn',
  zoom: 'zoom in to count single ticks',
  waiting: 'not known yet',
  no_truth: 'the true attack is not told',
  label: 'True and reconstructed attack on every channel of node {node}, lane {lane}',
  strip_label: '{channel}: {hits} hits, {misses} misses, {falses} false entries',
  modulo: 'mod 2π',
  modulo_deg: 'mod 360°',
  quality: 'Type {type}: exact support found in {exact} of the windows; {hit} of the entries found, {falses} false ones a window.',
  quality_head: 'Windows of {lane} attacked throughout, all nodes, the run so far.',
  quality_none: 'No window of {lane} has been attacked throughout in one way yet.',
  quality_other: 'The run’s metrics count exact supports only of lanes that pick single entries or whole channels; {lane} is not counted.',
  why: 'Why: see whether the attack can be identified',
  short_why: 'Why',
  column_true: '{channel} true',
  column_found: '{channel} found',
  range: 'range',
  azimuth: 'azimuth',
  elevation: 'elevation',
};

const zh: Translation<typeof en> = {
  title: '攻击重构',
  empty: '该运行没有重构攻击的方法。',
  node: '节点',
  other_lane: '{chosen} 不作重构，所示为 {lane}',
  truth: '真实',
  found: '重构',
  hit: '命中',
  marks: '命中：有攻击处找到攻击项，不论数值。漏检：未找到。误报：无攻击处找到攻击项。',
  miss: '漏检',
  false_entry: '误报',
  note: '最近 {n} 步',
  note_modulo: '角度按一周取模',
  zoom: '放大后可逐步计数',
  waiting: '尚不可知',
  no_truth: '未给出真实攻击',
  label: '{lane} 节点 {node} 各通道的真实攻击与重构攻击',
  strip_label: '{channel}：命中 {hits}，漏检 {misses}，误报 {falses}',
  modulo: '模 2π',
  modulo_deg: '模 360°',
  quality: '类型 {type}：{exact} 的窗口恢复了准确的支撑集；找到 {hit} 的攻击项，每个窗口误报 {falses} 项。',
  quality_head: '统计 {lane} 所有节点中全程受攻击的窗口，截至目前。',
  quality_none: '{lane} 尚无全程受同一类攻击的窗口。',
  quality_other: '本次运行的指标只统计逐项或逐通道挑选攻击的方法，{lane} 不在其中。',
  why: '原因：查看攻击能否被辨识',
  short_why: '原因',
  column_true: '{channel} 真实',
  column_found: '{channel} 重构',
  range: '距离',
  azimuth: '方位角',
  elevation: '俯仰角',
};

export const t = dictionary('reconstruction', en, zh);

/** A channel's name as a person reads it; one that nobody translated stays as it is. */
export function channelWord(name: string): string {
  return name === 'range' || name === 'azimuth' || name === 'elevation' ? t(name) : name;
}
