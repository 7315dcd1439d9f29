/// Two languages, typed: a missing Chinese word is a compile error.
///
/// A page keeps its words beside itself:
///   const en = { start: 'Start a run', of: '{n} of {m}' };
///   const zh: Translation<typeof en> = { start: '启动运行', of: '第 {n} 个，共 {m} 个' };
///   export const t = dictionary('runs', en, zh);
/// and calls t('of', { n: 3, m: 5 }) in its markup; the text follows the language by itself.
import { readQuery, setQuery } from '../router/router.svelte';
import { readPreference, writePreference } from '../theme/preferences';

export type Language = 'en' | 'zh';
export type Words = Record<string, string>;
export type Translation<T extends Words> = { [K in keyof T]: string };
export type Values = Record<string, string | number>;

function isLanguage(value: string | null): value is Language {
  return value === 'en' || value === 'zh';
}

function initial(): Language {
  const asked = readQuery('lang');
  if (isLanguage(asked)) return asked;
  const kept = readPreference('lang');
  if (isLanguage(kept)) return kept;
  return navigator.language?.toLowerCase().startsWith('zh') ? 'zh' : 'en';
}

let current = $state<Language>(initial());

export const language = {
  get current(): Language {
    return current;
  },
  /** For Intl and the lang attribute. */
  get tag(): string {
    return current === 'zh' ? 'zh-CN' : 'en';
  },
  set(next: Language): void {
    current = next;
    writePreference('lang', next);
    setQuery({ lang: next });
    apply();
  },
  toggle(): void {
    language.set(current === 'en' ? 'zh' : 'en');
  },
};

function apply(): void {
  document.documentElement.lang = language.tag;
}
apply();

const registered = new Map<string, { en: Words; zh: Words }>();

/** Every dictionary made so far, for the test that none is incomplete. */
export function dictionaries(): ReadonlyMap<string, { en: Words; zh: Words }> {
  return registered;
}

/** A page's own t(): key and values to the text in the current language. `name` must be unique. */
export function dictionary<T extends Words>(name: string, en: T, zh: Translation<T>): (key: keyof T & string, values?: Values) => string {
  registered.set(name, { en, zh });
  return (key, values) => fill((current === 'zh' ? zh : en)[key] ?? key, values);
}

function fill(text: string, values?: Values): string {
  if (!values) return text;
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => (name in values ? String(values[name]) : whole));
}

/** The member for the current language of what the server gives in both, e.g. a scenario's title. */
export function localised(text: { en: string; zh: string } | string | null | undefined): string {
  if (!text) return '';
  if (typeof text === 'string') return text;
  return text[current] || text.en;
}
