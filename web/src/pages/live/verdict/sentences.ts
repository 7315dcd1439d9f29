/// The verdict in words: which sentence is true of a report, and the numbers it holds. The words are in the dictionary.
import type { Metric } from '../../../api/types';
import { formatNumber } from '../../../i18n/format.svelte';
import { laneWord } from '../model';
import { percent, qualityOf } from '../reconstruction/quality';
import { complexPoles, coveredEntries, type Report } from './report';
import type { en } from './words';

export type Key = keyof typeof en;

export interface Sentence {
  key: Key;
  values: Record<string, string | number>;
  /** Whether a condition holds; null: no condition. */
  holds: boolean | null;
}

/** Every condition, one sentence each. */
export function conditions(report: Report, document: unknown): Sentence[] {
  const { q, qMax, eigvecSupport, phiSupport, dimension } = report;
  const sentences: Sentence[] = [dimensionSentence(report), eigenvectorSentence(report)];
  const phiHolds = phiSupport > dimension[0];
  sentences.push({ key: phiHolds ? 'phi_holds' : 'phi_fails', values: { least: phiSupport, need: dimension[0] }, holds: phiHolds });
  if (q > 0 && eigvecSupport > 0 && qMax !== q) sentences.push({ key: qMax > 0 ? 'q_max' : 'q_none', values: { q_max: qMax, q }, holds: null });
  sentences.push(coherenceSentence(report));
  if (complexPoles(document)) sentences.push({ key: 'poles', values: {}, holds: false });
  return sentences;
}

function dimensionSentence({ dimension: [need, room], dimensionOk }: Report): Sentence {
  return { key: dimensionOk ? 'dimension_holds' : 'dimension_fails', values: { need, room }, holds: dimensionOk };
}

function eigenvectorSentence({ q, eigvecSupport }: Report): Sentence {
  const holds = eigvecSupport > 2 * q;
  return { key: holds ? 'eigenvector_holds' : 'eigenvector_fails', values: { least: eigvecSupport, need: 2 * q, q }, holds };
}

function coherenceSentence({ coherence, stations, dimension, time }: Report): Sentence {
  const all = stations.map((station) => station.coherence);
  const entries = dimension[0] / 2;
  const covered = coveredEntries(coherence);
  const holds = covered >= entries;
  const least = all.length ? Math.min(...all) : coherence;
  const range = formatNumber(least, 2) === formatNumber(coherence, 2) ? formatNumber(coherence, 2) : `${formatNumber(least, 2)} … ${formatNumber(coherence, 2)}`;
  return { key: holds ? 'coherence_holds' : 'coherence_fails', values: { range, time: formatNumber(time), covered: Number.isFinite(covered) ? covered : '∞', fewer: Number.isFinite(covered) ? covered + 1 : '∞', entries }, holds };
}

/** What follows from the conditions. */
export function conclusion(report: Report): Sentence {
  const { q, dimensionOk, eigvecSupport, phiSupport, coherence, dimension } = report;
  if (!dimensionOk) return { key: 'so_impossible', values: { q }, holds: false };
  if (eigvecSupport <= 2 * q || phiSupport <= dimension[0]) return { key: 'so_open', values: { q }, holds: false };
  return coveredEntries(coherence) >= dimension[0] / 2 ? { key: 'so_found', values: { q }, holds: true } : { key: 'so_unique', values: { q }, holds: null };
}

/** Mean over the nodes of a figure of a lane; NaN where it has none. */
function overNodes(metrics: readonly Metric[], lane: string, name: string): number {
  const values = metrics.flatMap((one) => (one.lane === lane && one.name === name && one.node && typeof one.value === 'number' ? [one.value] : []));
  return values.length ? values.reduce((sum, value) => sum + value, 0) / values.length : NaN;
}

export interface Pair {
  /** The lane whose nodes play the game, and the one that reconstructs in the same way without it. */
  game: string;
  plain: string;
}

export function pairOf(lanes: readonly { id: string; method: string }[]): Pair | null {
  const of = (method: string): string | undefined => lanes.find((lane) => lane.method === method)?.id;
  const [game, plain] = [of('omp_game'), of('omp_ekf')];
  return game !== undefined && plain !== undefined ? { game, plain } : null;
}

/** What this run has measured so far of the lane's reconstructions. */
export function measured(metrics: readonly Metric[], lane: string): Sentence | null {
  const exact = qualityOf(metrics, lane).map((one) => `${percent(one.exact)} (${one.type})`);
  return exact.length ? { key: 'measured_exact', values: { lane: laneWord(lane), exact: exact.join(', ') }, holds: null } : null;
}

/** Whether the game or the reconstruction earns the accuracy, as far as this run tells. `unit`: of a square error. */
export function earned(metrics: readonly Metric[], pair: Pair | null, unit: string): Sentence | null {
  if (!pair) return null;
  const [withGame, without] = [overNodes(metrics, pair.game, 'mse_px'), overNodes(metrics, pair.plain, 'mse_px')];
  if (!Number.isFinite(withGame) || !Number.isFinite(without)) return null;
  const quality = qualityOf(metrics, pair.game);
  const found = quality.length > 0 && quality.every((one) => one.exact > 0.5);
  const key = withGame >= without ? 'game_no_better' : found ? 'game_and_support' : 'game_better';
  const values = { game: laneWord(pair.game), plain: laneWord(pair.plain), with: formatNumber(withGame), without: formatNumber(without), unit };
  return { key, values, holds: null };
}
