/// Which column of somebody's table is which signal: the object that `vigil trace table --map` takes, and back.
import { isObject, type Json, type JsonObject } from '../../../form/json';

/** What a trace of a scenario may hold, as the server says it. */
export interface ScenarioColumns {
  columns: string[];
  nodes: string[];
  lanes: string[];
  dt: number;
  mapping: JsonObject | null;
}

/** What a column is: a signal's name, `time`, `label`, or nothing. */
export type Role = string;
export const time: Role = 'time';
export const label: Role = 'label';
export const nothing: Role = '';

export interface Mapped {
  /** By the column's name. */
  roles: ReadonlyMap<string, Role>;
  dt: number;
  /** 1: a row's inputs act from that row on. */
  lag: 0 | 1;
  constants: JsonObject;
  /** Nodes that the label speaks of; null: all that have a reading here. */
  labelled: string[] | null;
}

const isSignal = (role: Role): boolean => role !== nothing && role !== time && role !== label;

/** Signals of a lane computed elsewhere: every component of the state at every node. */
export function laneSignals(of: ScenarioColumns, lane: string): string[] {
  const components = of.columns.filter((name) => name.startsWith('truth.')).map((name) => name.slice('truth.'.length));
  return of.nodes.flatMap((node) => components.map((component) => `lane.${lane}.${node}.estimate.${component}`));
}

/** Signals that more than one column would be. */
export function twice(roles: ReadonlyMap<string, Role>): string[] {
  const seen = new Map<Role, number>();
  for (const role of roles.values()) if (role !== nothing) seen.set(role, (seen.get(role) ?? 0) + 1);
  return [...seen].filter(([, n]) => n > 1).map(([role]) => role);
}

export function countSignals(roles: ReadonlyMap<string, Role>): number {
  return [...roles.values()].filter(isSignal).length;
}

function nodesRead(signals: readonly string[]): string[] {
  return [...new Set(signals.map((name) => /^sensor\.([^.]+)\./.exec(name)?.[1] ?? '').filter(Boolean))];
}

/** The mapping as the server and the command line read it. */
export function toJson({ roles, dt, lag, constants, labelled }: Mapped): JsonObject {
  const columns: JsonObject = {};
  for (const [column, role] of roles) if (isSignal(role)) columns[role] = column;
  const labels = [...roles].find(([, role]) => role === label);
  return {
    dt,
    columns,
    ...(Object.keys(constants).length ? { constants } : {}),
    ...(lag ? { input_lag: lag } : {}),
    ...(labels ? { label: { column: labels[0], nodes: labelled ?? nodesRead(Object.keys(columns)) } } : {}),
  };
}

/** Takes a mapping for a table's columns; null where it is none. Columns that the table does not have are left out. */
export function fromJson(value: Json, names: readonly string[], dt: number): Mapped | null {
  if (!isObject(value) || !isObject(value.columns)) return null;
  const roles = new Map(names.map((name): [string, Role] => [name, nothing]));
  for (const [signal, column] of Object.entries(value.columns as JsonObject)) if (typeof column === 'string' && roles.has(column)) roles.set(column, signal);
  const labels = isObject(value.label) ? (value.label as JsonObject) : null;
  if (typeof labels?.column === 'string' && roles.has(labels.column)) roles.set(labels.column, label);
  const nodes = Array.isArray(labels?.nodes) ? labels.nodes.filter((node): node is string => typeof node === 'string') : null;
  return {
    roles,
    dt: typeof value.dt === 'number' && value.dt > 0 ? value.dt : dt,
    lag: value.input_lag === 1 ? 1 : 0,
    constants: isObject(value.constants) ? (value.constants as JsonObject) : {},
    labelled: nodes,
  };
}

/** Columns that a mapping wants and the table does not have. */
export function lacking(value: Json, names: readonly string[]): string[] {
  if (!isObject(value) || !isObject(value.columns)) return [];
  const wanted = [...Object.values(value.columns as JsonObject), isObject(value.label) ? (value.label as JsonObject).column : undefined];
  return wanted.filter((column): column is string => typeof column === 'string' && !names.includes(column));
}
