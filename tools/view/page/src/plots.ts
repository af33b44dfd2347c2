// SPDX-License-Identifier: Apache-2.0
// Plots of fields over time: any numeric field of any topic, of all runs at once.

import uPlot from "uplot";

import { unit_of } from "./cdr_fields";
import { button, by_id, element, once_a_frame } from "./elements";
import type { Session } from "./session";
import { run_colour, run_dash, theme } from "./theme";

interface Plot {
  topic: string;
  path: string;
  box: HTMLElement;
  chart: uPlot | undefined;
  key: string;
}

const kMostPoints = 4000;

export class Plots {
  private readonly box = by_id("plots");
  private readonly plots: Plot[] = [];
  private readonly refresh = once_a_frame(() => this.refresh_now());

  constructor(private readonly session: Session) {
    session.listen((change) => {
      if (change === "tick") for (const plot of this.plots) plot.chart?.redraw(false);
      else if (change !== "playing") this.refresh();
    });
    new ResizeObserver(() => this.resize()).observe(this.box);
  }

  has(topic: string, path: string): boolean {
    return this.plots.some((plot) => plot.topic === topic && plot.path === path);
  }

  add(topic: string, path: string): void {
    if (this.has(topic, path)) return;
    const unit = unit_of(path);
    const title = `${topic}.${path}${unit ? ` [${unit}]` : ""}`;
    const box = element("figure", { "data-plot": `${topic}.${path}` }, element("figcaption", {}, title));
    const plot: Plot = { topic, path, box, chart: undefined, key: "" };
    box.firstElementChild?.append(button("×", "Remove this plot", () => this.remove(plot)));
    this.box.append(box);
    this.plots.push(plot);
    this.refresh();
  }

  /// What a plot shows of a run, for tests and for the legend.
  values(topic: string, path: string, run: number): [number, number][] {
    const found = this.session.runs[run]?.recording.topic(topic);
    if (!found) return [];
    return found.ticks.map((tick, i) => [tick, found.schema.number(found.sample(i), path)]);
  }

  private remove(plot: Plot): void {
    plot.chart?.destroy();
    plot.box.remove();
    this.plots.splice(this.plots.indexOf(plot), 1);
    this.session.tell("data");
  }

  private resize(): void {
    for (const plot of this.plots) plot.chart?.setSize({ width: this.box.clientWidth, height: 110 });
  }

  private refresh_now(): void {
    for (const plot of this.plots) {
      const shown = this.session.shown;
      const key = [theme().dark, ...shown.map((run) => `${run.index}:${run.ticks.length}`)].join(" ");
      if (key === plot.key || shown.length === 0) continue;
      plot.key = key;
      plot.chart?.destroy();
      plot.chart = this.chart(plot);
    }
  }

  private data(plot: Plot): uPlot.AlignedData {
    const shown = this.session.shown;
    const first = this.session.first_tick;
    const last = this.session.last_tick;
    const stride = Math.max(1, Math.ceil((last - first + 1) / kMostPoints));
    const ticks: number[] = [];
    for (let tick = first; tick <= last; tick += stride) ticks.push(tick);
    const tick_s = shown[0]?.tick_s ?? 1;
    const series = shown.map((run) => ticks.map((tick) => {
      const value = run.recording.topic(plot.topic)?.number_at(tick, plot.path) ?? NaN;
      return Number.isFinite(value) ? value : null;
    }));
    return [ticks.map((tick) => tick * tick_s), ...series];
  }

  private chart(plot: Plot): uPlot {
    const colours = theme();
    const shown = this.session.shown;
    const tick_s = shown[0]?.tick_s ?? 1;
    const axis: uPlot.Axis = {
      stroke: colours.faint, grid: { stroke: colours.grid, width: 1 }, ticks: { stroke: colours.grid, width: 1 },
      font: "11px system-ui, sans-serif",
    };
    const cursor = (chart: uPlot): void => {
      const x = chart.valToPos(this.session.tick * tick_s, "x", true);
      chart.ctx.save();
      chart.ctx.strokeStyle = colours.text;
      chart.ctx.lineWidth = window.devicePixelRatio || 1;
      chart.ctx.beginPath();
      chart.ctx.moveTo(x, chart.bbox.top);
      chart.ctx.lineTo(x, chart.bbox.top + chart.bbox.height);
      chart.ctx.stroke();
      chart.ctx.restore();
    };
    const made = new uPlot({
      width: this.box.clientWidth, height: 110, legend: { show: false }, padding: [6, 12, 0, 0],
      scales: { x: { time: false } },
      axes: [{ ...axis, size: 24, values: (_, values) => values.map((value) => `${value} s`) }, { ...axis, size: 74 }],
      series: [{}, ...shown.map((run) => ({
        label: run.recording.name, stroke: run_colour(colours, run.index), dash: run_dash(run.index), width: 1.5,
      }))],
      cursor: { drag: { x: false, y: false } },
      hooks: { draw: [cursor] },
    }, this.data(plot), plot.box);
    made.over.addEventListener("pointerdown", (event) => {
      this.session.go_to(made.posToVal(event.offsetX, "x") / tick_s);
    });
    made.over.addEventListener("pointermove", (event) => {
      if (event.buttons === 1) this.session.go_to(made.posToVal(event.offsetX, "x") / tick_s);
    });
    return made;
  }
}
