import { expect, test } from 'vitest';
import { lanesIn } from './traces';

const scenario = { columns: ['sensor.1.p', 'truth.x', 'truth.y'], lanes: ['consensus'] };

test('lanes that columns bring are those of estimates', () => {
  expect(lanesIn(['truth.x', 'sensor.1.p', 'lane.mine.1.estimate.x', 'lane.mine.fused.estimate.x', 'lane.mine.1.error', 'lane.a.truth.x'])).toEqual([{ lane: 'mine', whole: ['1', 'fused'], part: [] }]);
  expect(lanesIn([])).toEqual([]);
});

test('of a scenario they are not its own, and whole where no component is missing', () => {
  const columns = ['lane.consensus.1.estimate.x', 'lane.mine.1.estimate.x', 'lane.mine.1.estimate.y', 'lane.mine.2.estimate.y'];
  expect(lanesIn(columns, scenario)).toEqual([{ lane: 'mine', whole: ['1'], part: ['2'] }]);
});
