/// What the source prints in its Table 2 (seed 001, Table 2; specification, section 13): as printed, to be read beside ours.
export interface Printed {
  /** The source's number of the algorithm. */
  name: string;
  lane: string;
  /** One a node, in the order of `printedNodes`. */
  values: readonly string[];
}

export const printedNodes: readonly string[] = ['1', '2', '3', '4', '5'];

export const printed: readonly Printed[] = [
  { name: 'A1', lane: 'omp_game', values: ['0.0724', '0.0150', '0.0724', '1.3807', '0.0054'] },
  { name: 'A2', lane: 'l1', values: ['0.0238', '7.2185', '0.2550', '40.6553', '0.4213'] },
  { name: 'A3', lane: 'dkf', values: ['28.6083', '33.0688', '29.0511', '29.5093', '31.6166'] },
  { name: 'A4', lane: 'etpg', values: ['0.0302', '8.3714', '0.3338', '39.4624', '0.1078'] },
  { name: 'A5', lane: 'sdlms', values: ['3.6060', '3.5778', '3.6056', '3.5778', '3.5785'] },
];
