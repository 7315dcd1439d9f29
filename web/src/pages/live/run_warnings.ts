/// The run's warnings in the reader's language. The server writes them in English; what this page does not know stays as it is.
import { laneWord } from './model';
import { t } from './words';

const known: readonly (readonly [RegExp, (found: RegExpExecArray) => string])[] = [
  [/^residual identically zero: detector blind/, () => t('warning_blind')],
  [/^with tau (\S+) and eta (\S+) the printed threshold can never flag a step$/, ([, tau, eta]) => t('warning_never', { tau: tau!, eta: eta! })],
  [/^these are the source's printed gains, four digits each: their errors decay, but they do not estimate the attacks$/, () => t('warning_printed')],
  [/^subsystem (\S+): matching condition violated, rank\(C D\) < rank\(D\); it estimates no attack/, ([, id]) => t('warning_matching', { id: id! })],
  [/^these gains were given and have no certificate: (.*)$/s, ([, reason]) => t('warning_given', { reason: reason! })],
  [/^the network is not connected: its parts never hear of each other$/, () => t('warning_parts')],
];

export function warningText(warning: string): string {
  const [, lane, rest] = /^lane (\S+): (.*)$/s.exec(warning) ?? [null, null, warning];
  for (const [pattern, say] of known) {
    const found = pattern.exec(rest!);
    if (found) return lane === null ? say(found) : `${laneWord(lane!)}${t('colon')}${say(found)}`;
  }
  return warning;
}
