import { localised } from '../i18n/i18n.svelte';
import { rangeOf, type Fault } from './check';
import type { Field } from './fields';
import type { Json } from './json';
import { formWords as t } from './words';

/** A number as a person writes it: no rounding, no needless digits. */
export function plain(value: Json | undefined): string {
  if (value === undefined) return '';
  return typeof value === 'string' ? value : JSON.stringify(value);
}

/** [0, 1), ≥ 0, …; empty where there is no limit. */
export function rangeText(low: number | undefined, high: number | undefined, openLow: boolean, openHigh: boolean): string {
  if (low !== undefined && high !== undefined) return `${openLow ? '(' : '['}${low}, ${high}${openHigh ? ')' : ']'}`;
  if (low !== undefined) return `${openLow ? '>' : '≥'} ${low}`;
  if (high !== undefined) return `${openHigh ? '<' : '≤'} ${high}`;
  return '';
}

/** A limit so far away that it is no help to read. */
const kFar = 1e12;

export function fieldRange(field: Field): string {
  const { low, high, openLow, openHigh } = rangeOf(field);
  return rangeText(low, high !== undefined && high >= kFar ? undefined : high, openLow, openHigh);
}

/** A default or another value in words. */
export function spoken(field: Field, value: Json): string {
  if (value === null) return emptyWord(field);
  if (typeof value === 'boolean') return t(value ? 'on' : 'off');
  return plain(value);
}

/** What null means for a field: nothing at all, or that Vigil decides. */
export function emptyWord(field: Field): string {
  return /\bnone\b/.test(field.meaning.en) ? t('none') : t('automatic');
}

function sizeText(least: number | undefined, most: number | undefined): string {
  if (least !== undefined && least === most) return t('fault_size_exact', { least });
  return t('fault_size', { least: least ?? 0, most: most ?? '∞' });
}

/** A fault in the page's language. */
export function faultText(fault: Fault): string {
  switch (fault.code) {
    case 'number': return t('fault_number', { text: fault.text });
    case 'range': return t('fault_range', { range: rangeText(fault.low, fault.high, fault.openLow, fault.openHigh) });
    case 'choice': return t('fault_choice', { choices: fault.choices.map(plain).join(', ') });
    case 'size': return sizeText(fault.least, fault.most);
    case 'pattern': return t('fault_pattern', { pattern: fault.pattern });
    default: return t(`fault_${fault.code}`);
  }
}

export function meaning(field: Field): string {
  return localised(field.meaning);
}
