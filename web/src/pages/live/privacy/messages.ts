/// What goes to the fusion centre: links that are overheard or attacked, components that their sender contaminates.
import type { LaneModel, RunModel } from '../model';
import { known, namesOf } from './centre';

export interface Link {
  id: string;
  from: string;
  to: string;
  state: string | null;
  overheard: string | null;
}

/** Links to whom no node is: to the centre. */
export function linksOf(model: RunModel): Link[] {
  return model.links.map(({ id, from, to, state }) => ({ id, from, to, state, overheard: known(model, `link.${id}.overheard`) })).filter(({ to, overheard }) => overheard !== null || !model.nodes.some(({ id }) => id === to));
}

export interface Contaminated {
  node: string;
  component: string;
  signal: string;
}

/** Signals of a lane that tell which component of whose message is noise. */
export function contaminatedOf(model: RunModel, lane: Pick<LaneModel, 'id'> | null): Contaminated[] {
  if (!lane) return [];
  const names = [...namesOf(model)];
  return model.nodes.flatMap(({ id }) => {
    const head = `lane.${lane.id}.${id}.contaminated.`;
    return names.filter((name) => name.startsWith(head)).map((signal) => ({ node: id, component: signal.slice(head.length), signal }));
  });
}
