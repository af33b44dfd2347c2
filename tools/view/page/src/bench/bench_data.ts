// SPDX-License-Identifier: Apache-2.0
// What a bench's page holds, as tools/bench/bench_page.cpp writes it.

/// Which runs a cell or a point is about: of a variant, of a family, in worlds that can be solved or
/// not, with more than none of something.
export interface CellRuns {
  variant?: number;
  family?: string;
  solvable?: boolean | null;
  with?: "collisions" | "hit_by" | "safety_stops";
}
export interface Cell {
  text: string;
  runs?: CellRuns;
}
export interface Table {
  title: string;
  note: string;
  columns: string[];
  rows: Cell[][];
}
export interface Chart {
  title: string;
  note: string;
  unit: string;
  axis: [number, number] | null;
  points: { label: string; value: number; interval: [number, number] | null; runs: CellRuns }[];
}
export type Value = string | number | boolean | null;
export interface Runs {
  variants: string[];
  worlds: { name: string; family: string }[];
  columns: string[];
  /// Of very many some, with those that failed first.
  runs: Value[][];
  /// All there are.
  count: number;
  /// By the number of the run less one.
  kept: Record<string, { recording: string; report: string }>;
}
export interface Bench {
  title: string;
  about: string;
  remarks: string[];
  charts: Chart[];
  tables: Table[];
  pictures: { caption: string; svg: string }[];
  runs: Runs;
}
