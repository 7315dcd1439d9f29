import { dictionary } from '../../i18n/i18n.svelte';
import { en } from './words_en';
import { zh } from './words_zh';

export const t = dictionary('papers', en, zh);
