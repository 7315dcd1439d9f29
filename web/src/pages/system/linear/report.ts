/// What the server says of a described system (POST /systems/check).
import { post } from '../../../api/client';
import type { Localised } from '../../../api/types';
import type { JsonObject } from '../../../form/json';

export interface Mode {
  re: number;
  im: number;
  size: number;
  behaviour: 'decays' | 'stays' | 'grows';
  /** A conjugate pair is one mode, counted twice. */
  count: number;
  text: string;
}

/** What readings show of the plant, or an input moves of it. null: could not be worked out. */
export interface Sight {
  rank: number | null;
  hidden: Mode[] | null;
  weakest: { mode: string; value: number } | null;
  verdict: string;
}

export interface JointSight extends Sight {
  observable: boolean | null;
  detectable: boolean | null;
}

export interface NodeSight extends JointSight {
  id: string;
  channels: string[];
}

export interface ControlSight extends Sight {
  controllable: boolean | null;
  stabilisable: boolean | null;
}

export interface MethodFit {
  id: string;
  title: Localised;
  fits: boolean;
  reason: string | null;
  pointer: string | null;
  needs_gains: boolean;
}

export interface Report {
  scenario: string;
  tolerance: string;
  plant: {
    kind: 'discrete' | 'sampled' | 'linearised' | 'continuous';
    dt: number;
    states: string[];
    inputs: string[];
    poles: Mode[] | null;
    continuous_poles: Mode[] | null;
    measure: 'modulus' | 'real part';
    largest: number | null;
    stable: boolean | null;
    verdict: string;
  };
  nodes: NodeSight[];
  joint: JointSight;
  control: ControlSight | null;
  controller: { type: string; design: JsonObject; warnings?: string[] } | null;
  graph: { name: string; connected: boolean; components: { nodes: string[]; detectable: boolean | null; hidden: Mode[] | null }[]; verdict: string };
  methods: MethodFit[];
  run: { starts: boolean; reason: string | null; pointer: string | null; warnings: string[] };
}

/** Throws ApiProblem: 422 where no world can be made of the document, its pointers below /scenario. */
export const checkSystem = (document: JsonObject): Promise<Report> => post<Report>('/systems/check', { scenario: document });
