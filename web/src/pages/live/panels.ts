/// Which panels a run shows, in which order, and how much room each takes. A panel joins the page by one line here.
import type { Component } from 'svelte';
import { isIngest, isLive, type RunDetail } from '../../api/types';
import BoundPanel from './BoundPanel.svelte';
import DensityPanel from './density/DensityPanel.svelte';
import DetectorPanel from './detector/DetectorPanel.svelte';
import { aboutDetectors, detectorsOf } from './detector/detectors';
import EstimatesPanel from './ellipsoid/EstimatesPanel.svelte';
import ProfilePanel from './profile/ProfilePanel.svelte';
import RatesPanel from './rates/RatesPanel.svelte';
import TrialsPanel from './trials/TrialsPanel.svelte';
import WhatIfPanel from './whatif/WhatIfPanel.svelte';
import ComponentErrorsPanel from './component_errors/ComponentErrorsPanel.svelte';
import ErrorPanel from './ErrorPanel.svelte';
import EventsPanel from './EventsPanel.svelte';
import FeasiblePanel from './FeasiblePanel.svelte';
import { targetsOf } from './hands/hands.svelte';
import type { RunModel } from './model';
import { recordOf } from './observer/record';
import { hasSubsystems } from './observer/subsystems';
import PlanePanel from './PlanePanel.svelte';
import { hasCentre } from './privacy/centre';
import { hasMessages, promisesPrivacy, publishes, sizeIn } from './privacy/layout';
import FusionPanel from './fusion/FusionPanel.svelte';
import { gameOf } from './fusion/game';
import StrategyPanel from './fusion/StrategyPanel.svelte';
import RasterPanel from './RasterPanel.svelte';
import { reconstructionOf } from './reconstruction/channels';
import ReconstructionPanel from './reconstruction/ReconstructionPanel.svelte';
import { sensorsAttacked, stationsOf } from './schedule/schedule_cells';
import SchedulePanel from './schedule/SchedulePanel.svelte';
import { reportOf } from './verdict/report';
import VerdictPanel from './verdict/VerdictPanel.svelte';
import SpacePanel from './space/SpacePanel.svelte';
import { hasTable } from './sparse_table/assemble';
import Table2Panel from './sparse_table/Table2Panel.svelte';

export interface PanelEntry {
  name: string;
  /** The panel itself, or how it is fetched: what few runs have need not be there for all. */
  component?: Component;
  load?: () => Promise<{ default: Component }>;
  /** Whether the run has what the panel shows: decided by its family, its signals and the hints of its scenario. */
  applies: (run: RunDetail, model: RunModel) => boolean;
  /** Columns of twelve, and rows, on a wide screen. */
  wide: readonly [columns: number, rows: number];
  middle: readonly [columns: number, rows: number];
  /** Height in px where the panels stand one below the other. */
  narrow: number;
  /** Another size on a wide screen, beside what else the run shows; null: the usual one. */
  sized?: (run: RunDetail, model: RunModel) => readonly [columns: number, rows: number] | null;
}

const consensus = (run: RunDetail): boolean => run.family === 'consensus';
const detects = (run: RunDetail, model: RunModel): boolean => aboutDetectors(run) && detectorsOf(model, null).length > 0;
const subsystems = (_: RunDetail, model: RunModel): boolean => hasSubsystems(model);
const designed = (run: RunDetail, model: RunModel): boolean => hasSubsystems(model) || Object.keys(run.design ?? {}).some((lane) => recordOf(run, lane) !== null);
const centred = (_: RunDetail, model: RunModel): boolean => hasCentre(model);
const touched = (model: RunModel): boolean => targetsOf(model).length > 0;
const onPlane = (run: RunDetail, model: RunModel): boolean => consensus(run) || (!!model.plane && !run.view.space && !hasCentre(model));
/** No other panel draws its network so that one could take a link or a node. */
const needsNetwork = (run: RunDetail, model: RunModel): boolean => touched(model) && !onPlane(run, model) && !hasSubsystems(model) && !hasMessages(run, model);
const anyLane = (model: RunModel, has: (lane: RunModel['lanes'][number]) => unknown): boolean => model.lanes.some(has);

export const panels: readonly PanelEntry[] = [
  { name: 'readings', load: () => import('./ingest/ReadingsPanel.svelte'), wide: [12, 1], middle: [12, 1], narrow: 420, applies: (run) => isIngest(run.input) && isLive(run.state) },
  { name: 'tracks', load: () => import('./privacy/TracksPanel.svelte'), wide: [5, 1], middle: [12, 1], narrow: 400, applies: centred, sized: sizeIn('tracks') },
  { name: 'squares', load: () => import('./privacy/SquaresPanel.svelte'), wide: [7, 1], middle: [12, 1], narrow: 420, applies: centred, sized: sizeIn('squares') },
  { name: 'confidentiality', load: () => import('./privacy/ConfidentialityPanel.svelte'), wide: [7, 1], middle: [12, 1], narrow: 560, applies: centred },
  { name: 'guarantee', load: () => import('./privacy/GuaranteePanel.svelte'), wide: [5, 1], middle: [12, 1], narrow: 420, applies: promisesPrivacy },
  { name: 'releases', load: () => import('./privacy/ReleasesPanel.svelte'), wide: [4, 1], middle: [6, 1], narrow: 480, applies: promisesPrivacy, sized: sizeIn('releases') },
  { name: 'surfaces', load: () => import('./privacy/SurfacesPanel.svelte'), wide: [4, 1], middle: [6, 1], narrow: 480, applies: publishes, sized: sizeIn('surfaces') },
  { name: 'messages', load: () => import('./privacy/MessagesPanel.svelte'), wide: [4, 1], middle: [6, 1], narrow: 300, applies: hasMessages, sized: sizeIn('messages') },
  { name: 'state-errors', load: () => import('./observer/StateErrorsPanel.svelte'), wide: [5, 1], middle: [12, 1], narrow: 420, applies: subsystems },
  { name: 'attack-fault', load: () => import('./observer/AttackFaultPanel.svelte'), wide: [7, 1], middle: [12, 1], narrow: 560, applies: subsystems },
  { name: 'methods', load: () => import('./observer/ComparisonPanel.svelte'), wide: [7, 2], middle: [12, 1], narrow: 620, applies: subsystems },
  { name: 'subsystems', load: () => import('./observer/NetworkPanel.svelte'), wide: [5, 1], middle: [6, 1], narrow: 300, applies: subsystems },
  { name: 'design', load: () => import('./observer/DesignPanel.svelte'), wide: [5, 1], middle: [6, 1], narrow: 460, applies: designed },
  { name: 'detector', component: DetectorPanel, wide: [7, 2], middle: [12, 1], narrow: 480, applies: detects },
  { name: 'whatif', component: WhatIfPanel, wide: [5, 1], middle: [6, 1], narrow: 280, applies: detects },
  { name: 'profile', component: ProfilePanel, wide: [5, 1], middle: [6, 1], narrow: 330, applies: (run) => aboutDetectors(run) },
  { name: 'rates', component: RatesPanel, wide: [8, 1], middle: [12, 1], narrow: 420, applies: detects },
  { name: 'plane', component: PlanePanel, wide: [5, 2], middle: [6, 1], narrow: 330, applies: onPlane },
  { name: 'errors', component: ErrorPanel, wide: [7, 1], middle: [6, 1], narrow: 260, applies: (run, model) => consensus(run) || (!run.view.errors && !aboutDetectors(run) && !hasSubsystems(model) && !hasCentre(model) && anyLane(model, (lane) => lane.rmse || lane.error.size)) },
  { name: 'raster', component: RasterPanel, wide: [7, 1], middle: [6, 1], narrow: 340, applies: (run) => consensus(run) },
  { name: 'feasible', component: FeasiblePanel, wide: [4, 1], middle: [6, 1], narrow: 240, applies: (run, model) => consensus(run) || anyLane(model, (lane) => lane.feasible28.size) },
  { name: 'bound', component: BoundPanel, wide: [4, 1], middle: [6, 1], narrow: 240, applies: (run, model) => consensus(run) || (!run.view.errors && !aboutDetectors(run) && !hasCentre(model) && anyLane(model, (lane) => lane.bound.size)) },
  { name: 'estimates', component: EstimatesPanel, wide: [6, 2], middle: [12, 1], narrow: 560, applies: (run) => aboutDetectors(run) },
  { name: 'density', component: DensityPanel, wide: [6, 2], middle: [12, 1], narrow: 720, applies: (run) => aboutDetectors(run) },
  { name: 'trials', component: TrialsPanel, wide: [12, 1], middle: [12, 1], narrow: 460, applies: detects },
  { name: 'space', component: SpacePanel, wide: [4, 2], middle: [6, 1], narrow: 360, applies: (run) => !!run.view.space },
  { name: 'component-errors', component: ComponentErrorsPanel, wide: [4, 2], middle: [6, 1], narrow: 400, applies: (run) => !!run.view.errors?.length },
  { name: 'table2', component: Table2Panel, wide: [4, 2], middle: [12, 1], narrow: 560, applies: (run) => hasTable(run) },
  { name: 'fusion', component: FusionPanel, wide: [12, 1], middle: [12, 1], narrow: 300, applies: (_, model) => gameOf(model, null) !== null },
  { name: 'strategy', component: StrategyPanel, wide: [5, 1], middle: [6, 1], narrow: 270, applies: (_, model) => gameOf(model, null) !== null },
  { name: 'reconstruction', component: ReconstructionPanel, wide: [7, 2], middle: [6, 2], narrow: 500, applies: (_, model) => !hasSubsystems(model) && reconstructionOf(model, null) !== null },
  { name: 'schedule', component: SchedulePanel, wide: [5, 1], middle: [6, 1], narrow: 220, applies: (run, model) => sensorsAttacked(run) && !aboutDetectors(run) && stationsOf(model).length > 0 },
  { name: 'verdict', component: VerdictPanel, wide: [8, 1], middle: [12, 1], narrow: 420, applies: (run, model) => reportOf(run, model, null) !== null },
  { name: 'events', component: EventsPanel, wide: [4, 1], middle: [6, 1], narrow: 220, applies: () => true, sized: sizeIn('events') },
  { name: 'network', load: () => import('./hands/NetworkPanel.svelte'), wide: [4, 1], middle: [6, 1], narrow: 300, applies: needsNetwork },
  { name: 'attacks', load: () => import('./hands/AttacksPanel.svelte'), wide: [12, 1], middle: [12, 1], narrow: 260, applies: (_, model) => touched(model), sized: (run, model) => (needsNetwork(run, model) ? [8, 1] : null) },
];

const others = new WeakMap<PanelEntry, PanelEntry>();

/** The entry in another size, the same object as long as the size is the same: a panel whose entry is new is made anew. */
function resized(panel: PanelEntry, wide: PanelEntry['wide']): PanelEntry {
  if (wide.join() === panel.wide.join()) return panel;
  const known = others.get(panel);
  if (known?.wide.join() === wide.join()) return known;
  const entry = { ...panel, wide };
  others.set(panel, entry);
  return entry;
}

export function panelsOf(run: RunDetail, model: RunModel): readonly PanelEntry[] {
  return panels.filter((panel) => panel.applies(run, model)).map((panel) => resized(panel, panel.sized?.(run, model) ?? panel.wide));
}

export interface Rows {
  /** Shares of the screen's height of the rows that fill the first screen. Rows below it have a fixed height. */
  wide: readonly number[];
  /** px. */
  middle: readonly number[];
}

const usualRows: Rows = { wide: [29, 47, 29], middle: [320, 320, 260] };
const familyRows: Record<string, Rows> = {
  sparse: { wide: [1, 1, 1], middle: [400, 460, 300] },
  privacy: { wide: [9, 12, 9], middle: [360, 360, 420, 400, 340] },
  observer: { wide: [10, 9, 11], middle: [340, 340, 380, 320] },
};

export function rowsOf(run: RunDetail): Rows {
  return familyRows[run.family] ?? usualRows;
}

/** The first screen's rows as a value of grid-template-rows, inside a container whose height is 100cqh. */
export function wideTemplate({ wide }: Rows): string {
  const sum = wide.reduce((a, b) => a + b, 0);
  return wide.map((share) => `calc((max(100cqh, 560px) - ${wide.length - 1} * var(--gap)) * ${share / sum})`).join(' ');
}

export function middleTemplate({ middle }: Rows): string {
  return middle.map((height) => `${height}px`).join(' ');
}
