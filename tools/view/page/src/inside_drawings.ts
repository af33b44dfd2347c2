// SPDX-License-Identifier: Apache-2.0
// Grids as maps of grey and blue, the darker the more, with the value that counts now framed; lists
// as bars. Each says in words what it shows.

import { element, fit_canvas } from "./elements";
import type { Grid } from "./inside_values";
import { theme } from "./theme";

const kWidth = 340;
const kMostCell = 26;
const kBarsHeight = 54;

/// From the palest to the darkest, also in grey: cividis (Nuñez, Anderton & Renslow 2018), ends and
/// middle; then one of purples, for a second map beside it.
const kShades: [number, number, number][][] = [
  [[255, 234, 70], [124, 123, 120], [0, 32, 77]],
  [[252, 236, 246], [190, 110, 190], [70, 10, 90]],
];

export function shade(share: number, which = 0): string {
  const shades = kShades[which % kShades.length] ?? [];
  const at = Math.min(Math.max(share, 0), 1) * (shades.length - 1);
  const low = Math.min(Math.floor(at), shades.length - 2);
  const [a, b] = [shades[low], shades[low + 1]];
  if (!a || !b) return "#000";
  return `rgb(${a.map((value, i) => Math.round(value + (at - low) * ((b[i] ?? 0) - value))).join(" ")})`;
}

function readable(value: number): string {
  return Number.isInteger(value) ? String(value) : value.toPrecision(3);
}

/// Draws once the canvas has its size on the page.
function drawn_later(canvas: HTMLCanvasElement, draw: (g: CanvasRenderingContext2D) => void): void {
  requestAnimationFrame(() => draw(fit_canvas(canvas).g));
}

export function draw_grid(name: string, unit: string, grid: Grid): HTMLElement {
  const all = grid.values.flat();
  const least = all.reduce((a, b) => Math.min(a, b), Infinity);
  const most = all.reduce((a, b) => Math.max(a, b), -Infinity);
  const cell = Math.min(kMostCell, kWidth / grid.columns);
  const height = Math.max(1, Math.round(Math.min(cell * grid.rows, 1.2 * kWidth)));
  const row_height = height / grid.rows;
  const marked = grid.marked;
  const at = marked ? grid.values[marked[0]]?.[marked[1]] : undefined;
  const range = `from ${readable(least)} to ${readable(most)}${unit && ` ${unit}`}`;
  const now = marked && at !== undefined ? `; framed: ${readable(at)} at row ${marked[0]}, column ${marked[1]}` : "";
  const canvas = element("canvas", { role: "img", "aria-label": `${name}, ${grid.rows} rows by ${grid.columns} columns, ${range}${now}` });
  canvas.style.width = `${Math.round(cell * grid.columns)}px`;
  canvas.style.height = `${height}px`;
  drawn_later(canvas, (g) => {
    grid.values.forEach((row, y) => row.forEach((value, x) => {
      g.fillStyle = shade(most > least ? (value - least) / (most - least) : 0);
      g.fillRect(x * cell, y * row_height, cell + 0.5, row_height + 0.5);
    }));
    if (!marked) return;
    const frame = (width: number, colour: string): void => {
      g.strokeStyle = colour;
      g.lineWidth = width;
      g.strokeRect(marked[1] * cell - 1, marked[0] * row_height - 1, Math.max(cell, 5) + 2, Math.max(row_height, 5) + 2);
    };
    frame(4, "#fff");
    frame(2, "#d0004f");
  });
  return element("figure", { class: "grid" }, element("figcaption", {}, name), canvas,
    element("small", {}, `→ ${grid.columns_are}; ↓ ${grid.rows_are}. Dark is much: ${range}${now}.`));
}

export function draw_list(name: string, unit: string, values: number[]): HTMLElement {
  const least = Math.min(0, ...values);
  const most = Math.max(0, ...values);
  const said = `${values.length} values from ${readable(Math.min(...values))} to ${readable(Math.max(...values))}${unit && ` ${unit}`}`;
  const canvas = element("canvas", { role: "img", "aria-label": `${name}: ${said}` });
  const width = Math.min(kWidth, 28 * values.length);
  canvas.style.width = `${width}px`;
  canvas.style.height = `${kBarsHeight}px`;
  canvas.title = values.map(readable).join("  ");
  drawn_later(canvas, (g) => {
    const step = width / values.length;
    const level = (value: number): number => most > least ? kBarsHeight - 2 - (value - least) / (most - least) * (kBarsHeight - 4) : kBarsHeight - 2;
    const gap = step > 4 ? 1 : 0;
    g.fillStyle = theme().accent;
    values.forEach((value, i) => g.fillRect(i * step + gap, Math.min(level(value), level(0)), step - 2 * gap, Math.max(1, Math.abs(level(value) - level(0)))));
  });
  return element("figure", { class: "bars" }, element("figcaption", {}, name), canvas, element("small", {}, `${said}.`));
}
