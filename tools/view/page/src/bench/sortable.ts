// SPDX-License-Identifier: Apache-2.0
// A table that a click on a column's head sorts: by number where the column holds numbers.

import { button, element } from "../elements";

/// A share's per cent, else the first number; nothing where there is none.
export function number_in(text: string): number | undefined {
  const found = /(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?) %/.exec(text) ?? /^\s*(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)/.exec(text);
  return found ? Number(found[1]) : undefined;
}

/// Less than 0 if `a` comes before `b`; what has no number comes last.
export function compare_texts(a: string, b: string): number {
  const [x, y] = [number_in(a), number_in(b)];
  if (x !== undefined && y !== undefined && x !== y) return x - y;
  if ((x === undefined) !== (y === undefined)) return x === undefined ? 1 : -1;
  return a.localeCompare(b);
}

/// The heads of a table's columns. `on_sort` is told the column, and whether the least comes first.
export function column_heads(columns: string[], on_sort: (column: number, ascending: boolean) => void): HTMLTableRowElement {
  const row = element("tr");
  columns.forEach((column, index) => {
    const cell = element("th", { scope: "col", "aria-sort": "none" });
    cell.append(button(column === "" ? "·" : column, "Sort by this column; again: the other way round", () => {
      const ascending = cell.getAttribute("aria-sort") !== "ascending";
      for (const other of row.children) other.setAttribute("aria-sort", "none");
      cell.setAttribute("aria-sort", ascending ? "ascending" : "descending");
      on_sort(index, ascending);
    }));
    row.append(cell);
  });
  return row;
}
