/// Texts that more than one part of the page shows.
import type { Claim } from '../../api/papers';
import { formatNumber, missing } from '../../i18n/format.svelte';
import { localised } from '../../i18n/i18n.svelte';
import { t } from './words';

const sources = ['000', '001', '002', '003', '004'] as const;

export function sourceTitle(source: string): string {
  const known = sources.find((one) => one === source);
  return known ? t(`source_${known}`) : t('source_other', { source });
}

/** What an item or a claim says of its paper, in the page's language. */
export const paperOf = ({ paper, zh }: { paper: number | string | null; zh: { paper: number | string | null } }): string => paperText(typeof paper === 'string' && typeof zh.paper === 'string' ? localised({ en: paper, zh: zh.paper }) : paper);

/** A number and its standard error; what rounding left of an error is none. */
export function withError({ ours, se }: Pick<Claim, 'ours' | 'se'>, digits = 3): string {
  const text = formatNumber(ours, digits);
  if (ours === null || se === null) return text;
  return `${text}\u00a0± ${formatNumber(se < 1e-12 * Math.abs(ours) ? 0 : se, 2)}`;
}

/** A number as printed, or what the paper says. */
export function paperText(paper: number | string | null): string {
  if (paper === null) return missing;
  return typeof paper === 'string' ? paper : String(Number(paper.toPrecision(6)));
}

/** Bounds from 1e9 on are those of "at least". */
const unbounded = 1e9;

export function bandText({ low, high }: Pick<Claim, 'low' | 'high'>): string {
  const above = high === null || high >= unbounded;
  const below = low === null || low <= -unbounded;
  if (above && below) return t('any');
  if (above) return t('at_least', { low: formatNumber(low, 4) });
  if (below) return t('at_most', { high: formatNumber(high, 4) });
  return t('between', { low: formatNumber(low, 4), high: formatNumber(high, 4) });
}

/** Words and, between backticks, names in turn; an odd backtick is one of the words. */
export function pieces(text: string): string[] {
  const parts = text.split('`');
  return parts.length % 2 === 1 ? parts : [text];
}

/** What goes to a shell to get the same item. */
export function commandOf(key: string, runs: number, seed: number): string {
  return `vigil papers --only ${key} --runs ${runs} --seed ${seed}`;
}
