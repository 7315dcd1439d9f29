import { dictionary } from '../../../i18n/i18n.svelte';
import { en } from './words_en';
import { zh } from './words_zh';

export { en };
export const t = dictionary('hands', en, zh);
