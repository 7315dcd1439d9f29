import { dictionary, type Translation } from '../../../i18n/i18n.svelte';

const en = {
  bar: 'Branches',
  origin: 'Forked from run {run} at k = {k}.',
  show_origin: 'Show its origin',
  forks: 'Forked from here:',
  overlay: 'Overlay run {run}, from k = {k}',
  drawn: 'run {run}, thin and dotted, from k = {k}',
  loading: 'Fetching run {run}',
  foreign: 'Run {run} is no branch of this one: it is not drawn.',
  compare: 'Compare the two',
  hide: 'Hide it',
  with: 'with run {run}',
  key: 'run {run}',
  fork: 'fork',
} as const;

const zh: Translation<typeof en> = {
  bar: '分支',
  origin: '由运行 {run} 在 k = {k} 处分叉。',
  show_origin: '叠加其来源',
  forks: '由此分叉：',
  overlay: '叠加运行 {run}，自 k = {k}',
  drawn: '运行 {run}，细点线，自 k = {k}',
  loading: '正在读取运行 {run}',
  foreign: '运行 {run} 不是本运行的分支，未绘制。',
  compare: '比较两者',
  hide: '隐藏',
  with: '及运行 {run}',
  key: '运行 {run}',
  fork: '分叉',
};

export const t = dictionary('branch', en, zh);
