// SPDX-License-Identifier: Apache-2.0
// Numbers with their intervals: a row each, a dot on a line from end to end. Told by place alone,
// so a grey picture says the same.

import { element } from "../elements";
import type { CellRuns, Chart } from "./bench_data";

const kSvg = "http://www.w3.org/2000/svg";
const kRow = 24;
const kLabels = 260;
const kPlot = 420;
const kValues = 170;

function shape(name: string, attributes: Record<string, string | number>, text = ""): SVGElement {
  const made = document.createElementNS(kSvg, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  if (text !== "") made.textContent = text;
  return made;
}

function readable(value: number): string {
  return String(Number(value.toPrecision(3)));
}

/// Ends of the axis, and a step of 1, 2 or 5 between its lines.
function scale_of(chart: Chart): { low: number; high: number; step: number } {
  const all = chart.points.flatMap(({ value, interval }) => [value, ...(interval ?? [])]);
  let [low, high] = chart.axis ?? [Math.min(...all), Math.max(...all)];
  if (high - low < 1e-9) [low, high] = [low - 0.5, high + 0.5];
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5, 10].find((each) => each * power >= rough) ?? 10) * power;
  if (!chart.axis) [low, high] = [Math.floor(low / step) * step, Math.ceil(high / step) * step];
  return { low, high, step };
}

export function draw_chart(chart: Chart, show_runs: (runs: CellRuns, of: string) => void): HTMLElement {
  const { low, high, step } = scale_of(chart);
  const height = kRow * chart.points.length + 26;
  const x = (value: number): number => kLabels + (value - low) / (high - low) * kPlot;
  const svg = shape("svg", { viewBox: `0 0 ${kLabels + kPlot + kValues} ${height}`, role: "group", "aria-label": chart.title });
  for (let at = low; at <= high + 1e-9; at += step) {
    svg.append(shape("line", { class: "grid", x1: x(at), x2: x(at), y1: 0, y2: height - 22 }));
    svg.append(shape("text", { class: "axis", x: x(at), y: height - 8, "text-anchor": "middle" }, readable(at)));
  }
  svg.append(shape("text", { class: "axis", x: kLabels + kPlot + 14, y: height - 8 }, chart.unit));
  chart.points.forEach(({ label, value, interval, runs }, i) => {
    const y = kRow * (i + 0.5);
    const said = readable(value) + (interval ? ` [${readable(interval[0])}, ${readable(interval[1])}]` : "");
    const row = shape("g", { class: "point", role: "button", tabindex: 0, "aria-label": `${label}: ${said}; show its runs` });
    row.append(shape("rect", { class: "hit", x: 0, y: y - kRow / 2, width: kLabels + kPlot + kValues, height: kRow }));
    const name = shape("text", { x: kLabels - 12, y: y + 4, "text-anchor": "end" }, label.length > 38 ? `${label.slice(0, 37)}…` : label);
    name.append(shape("title", {}, label));
    row.append(name);
    if (interval) {
      row.append(shape("line", { class: "interval", x1: x(interval[0]), x2: x(interval[1]), y1: y, y2: y }));
      for (const end of interval) row.append(shape("line", { class: "interval", x1: x(end), x2: x(end), y1: y - 5, y2: y + 5 }));
    }
    row.append(shape("circle", { class: "value", cx: x(value), cy: y, r: 4.5 }));
    row.append(shape("text", { x: kLabels + kPlot + 14, y: y + 4 }, said));
    const show = (): void => show_runs(runs, `${chart.title}: ${label}`);
    row.addEventListener("click", show);
    row.addEventListener("keydown", (event) => {
      const { key } = event as KeyboardEvent;
      if (key !== "Enter" && key !== " ") return;
      event.preventDefault();
      show();
    });
    svg.append(row);
  });
  const figure = element("figure", { class: "chart" }, element("figcaption", {}, chart.title));
  figure.append(svg, element("small", {}, chart.note));
  return figure;
}
