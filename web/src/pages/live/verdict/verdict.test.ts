import { describe, expect, it } from 'vitest';
import type { Metric, RunDetail } from '../../../api/types';
import { language } from '../../../i18n/i18n.svelte';
import { makeModel } from '../model';
import { complexPoles, coveredEntries, readReport, reportOf, type Report } from './report';
import { conclusion, conditions, earned, measured, pairOf, type Sentence } from './sentences';
import { t } from './words';

/** As the engine makes it for the paper's network. */
const paper = {
  time: 5, q: 2, q_max: 1, dimension_ok: true, dimension: [24, 30], eigvec_support: 3, phi_support: 18, coherence: 0.431,
  stations: [
    { node: '1', eigvec_support: 3, phi_support: 18, coherence: 0.382 },
    { node: '2', eigvec_support: 3, phi_support: 18, coherence: 0.431 },
  ],
};
const read = (changes: Record<string, unknown> = {}): Report => readReport({ ...paper, ...changes })!;
const say = (sentence: Sentence): string => t(sentence.key, sentence.values);
const poles = (imaginary: number) => ({ plant: { params: { poles_x: [0.99, imaginary], poles_y: [0.98, 0] } } });

describe('a report', () => {
  it('is read, or refused as a whole', () => {
    expect(read()).toMatchObject({ q: 2, qMax: 1, dimension: [24, 30], eigvecSupport: 3 });
    expect(read().stations[1]).toEqual({ node: '2', eigvecSupport: 3, phiSupport: 18, coherence: 0.431 });
    for (const wrong of [null, 3, {}, { ...paper, dimension: [24] }, { ...paper, coherence: null }, { ...paper, dimension_ok: 1 }]) expect(readReport(wrong)).toBeNull();
    expect(read({ stations: [{ node: 1 }] }).stations).toEqual([]);
  });

  it('is that of the chosen lane, or of the first that has one', () => {
    const run = { view: {}, world: { nodes: [], links: [], lanes: ['pred', 'omp', 'omp_game'].map((id) => ({ id, method: '', adversary: true })), state: [] }, design: { omp: { identifiability: { ...paper, q: 1 } }, omp_game: { identifiability: paper } } } as unknown as RunDetail;
    const model = makeModel(run, []);
    expect(reportOf(run, model, 'omp_game')?.report.q).toBe(2);
    expect(reportOf(run, model, 'pred')?.lane.id).toBe('omp');
    expect(reportOf({ design: {} }, model, null)).toBeNull();
  });

  it('covers fewer entries than (1 + 1/mu)/2', () => {
    expect([0.51, 0.431, 0.33, 1 / 3, 0.2, 1, 0].map(coveredEntries)).toEqual([1, 1, 2, 1, 2, 0, Infinity]);
  });

  it('knows complex poles, or that nobody told', () => {
    expect([complexPoles(poles(0.01)), complexPoles(poles(0)), complexPoles({ plant: { params: {} } }), complexPoles(null)]).toEqual([true, false, null, null]);
  });
});

describe('the verdict', () => {
  it('of the paper’s own setting: the count holds, the tests fail, q = 1 is the most', () => {
    language.set('en');
    const sentences = conditions(read(), poles(0.01));
    expect(sentences.map(({ key, holds }) => [key, holds])).toEqual([
      ['dimension_holds', true],
      ['eigenvector_fails', false],
      ['phi_fails', false],
      ['q_max', null],
      ['coherence_fails', false],
      ['poles', false],
    ]);
    const text = sentences.map(say).join(' ');
    for (const part of ['2qT = 24 is not more than pT − n = 30', 'more than 2q = 4 channels of a station, and the least is 3', 'q ≤ 1', '0.38 … 0.43', 'fewer than 2 entries', 'up to qT = 12']) expect(text).toContain(part);
    expect(say(conclusion(read()))).toContain('Nothing in the paper promises that an attack on q = 2 channels is unique');
  });

  it('of q = 1: the tests pass, and still nothing promises that OMP finds it', () => {
    const report = read({ q: 1, dimension: [12, 30] });
    expect(conditions(report, poles(0)).map(({ key, holds }) => [key, holds])).toEqual([
      ['dimension_holds', true],
      ['eigenvector_holds', true],
      ['phi_holds', true],
      ['coherence_fails', false],
    ]);
    expect(conclusion(report).key).toBe('so_unique');
  });

  it('follows every other report', () => {
    expect(conclusion(read({ dimension_ok: false, dimension: [60, 30] })).key).toBe('so_impossible');
    expect(conditions(read({ dimension_ok: false, dimension: [60, 30] }), null)[0]).toMatchObject({ key: 'dimension_fails', holds: false });
    expect(conclusion(read({ q: 1, dimension: [12, 30], phi_support: 12 })).key).toBe('so_open');
    expect(conclusion(read({ q: 1, dimension: [12, 30], coherence: 0.08 })).key).toBe('so_found');
    expect(conditions(read({ q_max: 0, eigvec_support: 2 }), null).map(({ key }) => key)).toContain('q_none');
    const single = conditions(read({ stations: [], coherence: 0.5 }), null).find(({ key }) => key === 'coherence_fails')!;
    expect(single.values).toMatchObject({ range: '0.50', covered: 1, fewer: 2 });
  });

  it('in Chinese holds the same numbers', () => {
    language.set('zh');
    const text = conditions(read(), poles(0.01)).map(say).join('');
    for (const part of ['2qT = 24', 'pT − n = 30', '2q = 4', 'q ≤ 1', 'qT = 12']) expect(text).toContain(part);
    language.set('en');
  });
});

describe('what the run itself shows', () => {
  const metric = (lane: string, name: string, value: number, node: string | null = null, variant: string | null = null): Metric => ({ lane, node, name, variant, value });
  const pair = { game: 'omp_game', plain: 'omp' };
  const errors = (withGame: number, without: number): Metric[] => ['1', '2'].flatMap((node) => [metric('omp_game', 'mse_px', withGame, node), metric('omp', 'mse_px', without, node)]);

  it('is the share of exact supports, by type', () => {
    const metrics = [metric('omp_game', 'omp_exact', 0, null, 'I'), metric('omp_game', 'omp_exact', 0, null, 'II')];
    expect(say(measured(metrics, 'omp_game')!)).toContain('omp game finds the exact support in 0 % (I), 0 % (II)');
    expect(measured(metrics, 'omp')).toBeNull();
  });

  it('gives the accuracy to the game only where the run says so', () => {
    const exact = (share: number): Metric[] => [metric('omp_game', 'omp_exact', share, null, 'I')];
    const better = earned([...errors(0.35, 46), ...exact(0)], pair, 'm²')!;
    expect(better.key).toBe('game_better');
    expect(say(better)).toMatch(/comes from the game, not from the reconstruction.*0\.350 m².*46\.0 m² in omp/);
    expect(earned([...errors(0.35, 46), ...exact(1)], pair, 'm²')!.key).toBe('game_and_support');
    expect(earned([...errors(3, 2), ...exact(0)], pair, 'm²')!.key).toBe('game_no_better');
    expect(earned(errors(3, 2).slice(0, 1), pair, 'm²')).toBeNull();
    expect(earned(errors(3, 2), null, 'm²')).toBeNull();
  });

  it('compares the lanes of the two methods, whatever they are called', () => {
    expect(pairOf([{ id: 'a', method: 'omp_game' }, { id: 'b', method: 'omp_ekf' }])).toEqual({ game: 'a', plain: 'b' });
    expect(pairOf([{ id: 'a', method: 'omp_game' }])).toBeNull();
  });
});
