// SPDX-License-Identifier: Apache-2.0
// The values that a component tells of its inside, as `clew explain --json` writes them.

import type { Point } from "./world";

export interface Grid {
  columns: number;
  rows: number;
  columns_are: string;
  rows_are: string;
  values: number[][];
  marked: [number, number] | null;
}
export type Value = null | boolean | number | string | Grid | Group | (number | Group)[];
export interface Group {
  [name: string]: Value;
}

export type LayerKind = "values" | "blocked" | "points" | "way" | "goal";

/// What is drawn over the map, in the frame of odometry.
export interface PictureLayer {
  name: string;
  kind: LayerKind;
  places: Point[];
  cells: { corners: Point[]; value: number }[];
}

export function is_grid(value: Value): value is Grid {
  return typeof value === "object" && value !== null && !Array.isArray(value) && "columns_are" in value;
}
