import { describe, expect, it } from 'vitest';
import type { Metric, RunDetail } from '../../../api/types';
import { language } from '../../../i18n/i18n.svelte';
import { warningText } from '../run_warnings';
import { blindness, kindOf } from './facts';
import { abilities, doings, gainText, heading, measured, type Sentence } from './sentences';
import { countingOf, laneSettings, ruleOf } from './settings';
import { t } from './words';

const printed = { mu: 0, zeta_max: null, residual: 'posterior', window: 5, threshold: 'printed', tau: 15, eta: 2, iota: 0.1, dead_band: 'held', watermark: 'none', amplitude: 0 };
const mixed = (params: object = {}, path = 'loop') => ({ method: 'mixed_filter', path, params: { ...printed, ...params } });
// Names that would mislead whoever goes by them.
const lanes = {
  repaired: mixed(),
  as_written: mixed({ zeta_max: 1, threshold: 'frozen', tau: 40, eta: 3, watermark: 'sensor', amplitude: 2 }),
  literal: mixed({}, 'monitor'),
  literal_freeze: mixed({ threshold: 'frozen' }, 'monitor'),
  innov: mixed({ residual: 'innovation' }),
  zeta1: mixed({ zeta_max: 1 }),
  ctrl: mixed({ residual: 'innovation', watermark: 'control', amplitude: 4 }),
  idle_mark: mixed({ watermark: 'sensor', amplitude: 0 }),
  fixed: mixed({ zeta_max: 1, threshold: 'fixed_norm' }, 'monitor'),
  ufir: { method: 'ufir_filter', path: 'loop', params: { N: 10 } },
  gmeekf: { method: 'gmeekf', path: 'loop', params: { alpha: 2, beta: 2, form: 'square' } },
  zonotope: { method: 'zonotope_watermark', path: 'loop', params: { rho: 3 } },
};
const corner = { K: [[0.92933, -0.23557], [0.35336, 1.17786]], zeta: null, corner: 'zeta = inf', longest_step_flag: 2 };
const inside = { K: [[0.7848, -0.2064], [0.2739, 0.9352]], zeta: 1, corner: 'none', blind: false, longest_step_flag: 2 };
const run = {
  document: { lanes, controller: { params: { reference: 'zero' } }, metrics: { detection: { from: 50 } } },
  commands: [],
  design: { repaired: { ...corner, blind: true }, as_written: inside, literal: { ...corner, blind: false }, literal_freeze: { ...corner, blind: false }, innov: { ...corner, blind: false }, zeta1: inside, ctrl: inside, fixed: inside },
  warnings: [],
} as unknown as RunDetail;
const keys = (sentences: readonly Sentence[]): string[] => sentences.map(({ key }) => key);
const said = (sentences: readonly Sentence[]): string => sentences.map(({ key, values }) => t(key, values)).join(' ');

describe('a profile', () => {
  it('is told by its path and parameters, not by its name', () => {
    const kinds = Object.fromEntries(Object.keys(lanes).map((lane) => [lane, kindOf(laneSettings(run, lane))]));
    expect(kinds).toEqual({
      repaired: 'printed', as_written: 'changed', literal: 'eq29', literal_freeze: 'changed', innov: 'changed', zeta1: 'changed', ctrl: 'changed', idle_mark: 'printed', fixed: 'fixed', ufir: 'ufir', gmeekf: 'gmeekf', zonotope: 'zonotope',
    });
  });

  it('is called the paper’s method only where it is', () => {
    language.set('en');
    for (const lane of Object.keys(lanes)) {
      const paper = ['repaired', 'idle_mark', 'literal'].includes(lane);
      expect(t(heading(run, lane).key).startsWith('The paper’s method'), lane).toBe(paper);
    }
  });

  it('names every change it makes', () => {
    expect(keys(doings(run, 'as_written'))).toEqual(['path_loop', 'change_zeta', 'change_frozen', 'change_sensor', 'numbers_own']);
    expect(said(doings(run, 'as_written'))).toMatch(/ζ is capped at 1.*amplitude 2.*τ = 40, η = 3, ι = 0\.1; none of the paper/);
    expect(keys(doings(run, 'repaired'))).toEqual(['path_loop', 'numbers_paper']);
    expect(keys(doings(run, 'literal'))).toEqual(['path_monitor', 'numbers_paper']);
    expect(keys(doings(run, 'fixed'))).toEqual(['path_monitor', 'change_zeta', 'change_fixed_norm']);
    expect(said(doings(run, 'gmeekf'))).toContain('α = 2, β = 2, form square');
    expect(keys(doings({ ...run, document: { lanes: { a: mixed({ mu: 1, zeta_max: 1 }) } } }, 'a'))).toContain('change_zeta_idle');
  });

  it('follows what was changed while it ran', () => {
    const changed = { ...run, commands: [{ k: 9, body: { params: { 'lanes.repaired.params.threshold': 'frozen', 'lanes.zeta1.params.eta': 9 } } }] };
    expect(kindOf(laneSettings(changed, 'repaired'))).toBe('changed');
    expect(laneSettings(changed, 'zeta1')!.params.eta).toBe(9);
    expect(laneSettings(run, 'nobody')).toBeNull();
  });
});

describe('blindness', () => {
  it('is that of a residual which is zero whatever is replayed', () => {
    expect(Object.fromEntries(Object.keys(lanes).map((lane) => [lane, blindness(run, lane)]).filter(([, blind]) => blind !== null))).toEqual({ repaired: 'blind', literal: 'quiet', literal_freeze: 'quiet' });
    expect(keys(abilities(run, 'repaired'))).toEqual(['blind']);
    expect(said(abilities(run, 'repaired'))).toContain('K = C⁻¹');
  });

  it('is confirmed by the run’s own warning, of this lane only', () => {
    const warned = { ...run, warnings: ['lane repaired: residual identically zero: detector blind (the optimal gain is C^-1, whatever is replayed)'] };
    expect(keys(abilities(warned, 'repaired'))).toEqual(['blind', 'blind_seen']);
    expect(blindness(warned, 'zeta1')).toBeNull();
    expect(blindness({ ...run, warnings: ['lane zeta1: residual identically zero: detector blind (…)'] }, 'zeta1')).toBe('blind');
  });
});

describe('what a detector can do', () => {
  it('says how long the printed threshold holds a flag, by the engine’s own count', () => {
    expect(keys(abilities(run, 'zeta1'))).toEqual(['stealthy', 'holds_printed']);
    expect(said(abilities(run, 'zeta1'))).toContain('at most 2 samples');
    expect(keys(abilities({ ...run, design: { zeta1: { ...inside, longest_step_flag: 0 } } }, 'zeta1'))).toContain('holds_never');
    expect(keys(abilities({ ...run, design: {} }, 'zeta1'))).toContain('holds_unknown');
  });

  it('calls a replay stealthy only without a watermark, with reference zero, on the loop', () => {
    expect(keys(abilities(run, 'as_written'))).toEqual(['holds_frozen']);
    expect(keys(abilities(run, 'ctrl'))).toEqual(['holds_printed']);
    expect(keys(abilities(run, 'literal_freeze'))).toEqual(['quiet', 'holds_frozen']);
    expect(keys(abilities(run, 'fixed'))).toEqual(['holds_fixed']);
    const sine = { ...run, document: { ...run.document, controller: { params: { reference: 'sine' } } } };
    expect(keys(abilities(sine, 'zeta1'))[0]).toBe('stealthy_reference');
    expect(abilities(run, 'ufir')).toEqual([]);
  });
});

describe('what the run measured', () => {
  const metric = (name: string, value: number): Metric => ({ lane: 'a', node: null, name, variant: null, value });
  const all = [metric('tpr', 0.1), metric('fpr', 0.006), metric('accuracy', 0.743), metric('event', 1), metric('event_without_attack', 1)];

  it('stands beside what saying nothing would reach, and an event beside that without an attack', () => {
    language.set('en');
    const text = said(measured(all, 'a', 0.733));
    for (const part of ['10 % of the attacked ticks', '0.6 % of the others', 'right at 74 %', 'right at 73 %', 'says nothing']) expect(text).toContain(part);
    expect(keys(measured([...all.slice(0, 4), metric('event_without_attack', 0)], 'a', 0.733))).not.toContain('event_says_nothing');
  });

  it('is less before any attack, and nothing before any tick', () => {
    expect(keys(measured([metric('fpr', 0), metric('accuracy', 1)], 'a', 1))).toEqual(['measured_calm']);
    expect(measured([], 'a', null)).toEqual([]);
    expect(measured(all, 'b', null)).toEqual([]);
  });

  it('names the gain, and an endless ζ', () => {
    expect(gainText(run, 'repaired')).toBe('K = [0.929 -0.236; 0.353 1.18], ζ = ∞');
    expect(gainText(run, 'zeta1')).toContain('ζ = 1.00');
    expect(gainText(run, 'ufir')).toBeNull();
  });
});

describe('settings', () => {
  it('give the rule of a what-if and what counts', () => {
    expect(ruleOf(laneSettings(run, 'as_written'), 7)).toMatchObject({ rule: 'frozen', tau: 40, eta: 3, iota: 0.1, deadBand: 'held' });
    expect(ruleOf(laneSettings(run, 'fixed'), 7)).toMatchObject({ rule: 'fixed', level: 7 });
    expect(ruleOf(laneSettings(run, 'zonotope'), 1)).toMatchObject({ rule: 'fixed', level: 1 });
    expect(countingOf(run, laneSettings(run, 'repaired'))).toEqual({ from: 50, tail: 4 });
    expect(countingOf({ document: { metrics: { detection: { from: 20 } } } }, laneSettings(run, 'zonotope'))).toEqual({ from: 20, tail: 0 });
  });
});

describe('warnings of a run', () => {
  const blind = 'lane as_written: residual identically zero: detector blind (the optimal gain is C^-1, whatever is replayed)';
  it('are said in the reader’s language where the page knows them', () => {
    language.set('en');
    expect(warningText(blind)).toBe('as written: the residual is identically zero and the detector blind: the optimal gain is C⁻¹, whatever is replayed');
    expect(warningText('lane a: with tau 10 and eta 3 the printed threshold can never flag a step')).toBe('a: with τ = 10 and η = 3 the printed threshold can never flag a step');
    expect(warningText('something new')).toBe('something new');
    expect(warningText('lane a: something new')).toBe('lane a: something new');
    language.set('zh');
    expect(warningText(blind)).toContain('检测器是盲的');
    language.set('en');
  });
});
