// SPDX-License-Identifier: Apache-2.0
// What the page asks of the server besides bytes: what there is to choose from, branches, runs, insides.

import type { Group, PictureLayer } from "./inside_values";

export interface Parameter {
  name: string;
  unit: string;
  doc: string;
  default: boolean | number | string | string[];
  range?: [number, number];
  choices?: string[];
  folder?: string;
}
export interface Behaviour {
  name: string;
  summary: string;
  parameters: Parameter[];
}
export interface Part {
  name: string;
  is_list: boolean;
  variants: Behaviour[];
}
export interface Stage {
  name: string;
  summary: string;
  parameters: Parameter[];
  parts: Part[];
}
export interface Choices {
  stages: Stage[];
  graphs: string[];
  worlds: string[];
}

/// One value in the place of another.
export interface SetEntry {
  stage: string;
  part: string;
  behaviour: string;
  name: string;
  value: boolean | number | string;
}
export interface Changes {
  with: Record<string, string[]>;
  set: SetEntry[];
}

/// A rule base in the place of the one that a parameter names.
export interface RuleEdit {
  stage: string;
  part: string;
  behaviour: string;
  name: string;
  text: string;
}

/// What became of a branch or a run.
export interface Started {
  command: string;
  recording: number;
  name: string;
  report: { outcome: string; ticks: number; hash: string | null; path_length_m: number };
}

/// What a person wants of a run under way.
export type Order =
  | { order: "pause" | "resume" | "stop" }
  | { order: "step"; ticks: number }
  | { order: "pace"; factor: number }
  | { order: "goal"; x: number; y: number }
  | ({ order: "swap"; rules?: RuleEdit[] } & Changes);
/// From which tick on it holds, and the command line that does the same.
export interface Carried {
  tick: number;
  command: string;
}

/// What a component told of a tick.
export interface StageTold {
  stage: string;
  behaviour: string;
  tick: number;
  text: string;
  inside: Group;
  /// What of it has a place.
  picture: PictureLayer[];
}
export interface Told {
  command: string;
  stages: StageTold[];
}

export async function read_choices(): Promise<Choices> {
  return await (await fetch("choices")).json() as Choices;
}

/// Throws what the server says is wrong.
async function post<T>(what: string, request: object): Promise<T> {
  const answer = await fetch(what, { method: "POST", body: JSON.stringify(request) });
  const told = await answer.json() as T & { error?: string };
  if (!answer.ok) throw new Error(told.error ?? `status ${answer.status}`);
  return told;
}

export function ask_for(what: "branch" | "run", request: object): Promise<Started> {
  return post<Started>(what, request);
}

export function ask_control(order: Order): Promise<Carried> {
  return post<Carried>("control", order);
}

export function ask_insides(of: { recording: number; tick: number }): Promise<Told> {
  return post<Told>("explain", of);
}
