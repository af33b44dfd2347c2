// SPDX-License-Identifier: Apache-2.0
// A lane for each stage: what happened when. Bands tell what lasts, marks what happens at a tick.

import { by_id, fit_canvas, once_a_frame } from "./elements";
import { by_weight, round_up } from "./map_layers";
import type { Run, RunEvent } from "./run";
import type { Session } from "./session";
import { draw_mark, kKindNames, run_colour, theme } from "./theme";
import type { Theme } from "./theme";

const kLeft = 74;
const kLane = 19;
const kAxis = 18;

interface Lane {
  stage: string;
  /// The shade of a tick, 0 to 1, and the topic that tells it; none: no band.
  topic?: string;
  path?: string;
  shade?: (value: number) => number;
  meaning: string;
}

const kLanes: Lane[] = [
  { stage: "run", meaning: "pauses, pace; what befell the run" },
  { stage: "drive", topic: "state", path: "speed_mps", shade: (v) => (v > 1e-9 ? 0.15 : 0), meaning: "moving; way-points, new targets, safety stops, contacts, late commands" },
  { stage: "sense", topic: "scan", meaning: "how near the nearest return is" },
  { stage: "classify", topic: "landmark", path: "spatial_class", shade: (v) => 0.1 + v * 0.07, meaning: "spatial class 0 to 8; landmarks" },
  { stage: "plan", topic: "target", path: "x_m", meaning: "subgoals" },
  { stage: "recover", topic: "guidance", path: "mode", shade: (v) => (v === 0 ? 0 : v === 1 ? 0.5 : 0.9), meaning: "an escape at work; traps, escapes, virtual targets" },
  { stage: "control", topic: "guidance", path: "has_override", shade: (v) => (v === 1 ? 0.35 : 0), meaning: "recover's motion in place of control's own" },
];

export class Lanes {
  private readonly canvas = by_id<HTMLCanvasElement>("lanes");
  private base: HTMLCanvasElement | undefined;
  private base_key = "";
  private readonly draw = once_a_frame(() => this.draw_now());

  constructor(private readonly session: Session) {
    session.listen(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    this.add_pointer();
  }

  private lanes(run: Run): Lane[] {
    // A run that nobody touched and nothing befell has no lane for that.
    const always = (stage: string): boolean => stage === "drive" ? run.ticks.length > 0 : stage === "run" && run.has_run_events;
    return kLanes.filter((lane) => lane.stage in run.graph || always(lane.stage));
  }

  private x_of(tick: number, width: number): number {
    const first = Number.isFinite(this.session.first_tick) ? this.session.first_tick : 0;
    const span = Math.max(1, this.session.last_tick - first);
    return kLeft + ((tick - first) / span) * (width - kLeft - 12);
  }

  private tick_at(x: number): number {
    const width = this.canvas.clientWidth;
    const first = Number.isFinite(this.session.first_tick) ? this.session.first_tick : 0;
    return first + ((x - kLeft) / (width - kLeft - 12)) * Math.max(1, this.session.last_tick - first);
  }

  private draw_now(): void {
    const run = this.session.run;
    if (run) this.canvas.style.height = `${this.lanes(run).length * kLane + kAxis}px`;
    const { g, width, height } = fit_canvas(this.canvas);
    g.clearRect(0, 0, width, height);
    if (!run || run.ticks.length === 0) return;
    // Bands and marks change with the data only; a frame while scrubbing copies them.
    const key = [run.index, run.ticks.length, run.events.length, this.session.last_tick, this.session.first_tick, width,
      height, theme().dark, window.devicePixelRatio].join(" ");
    if (key !== this.base_key || !this.base) {
      this.base = document.createElement("canvas");
      this.base.width = this.canvas.width;
      this.base.height = this.canvas.height;
      const base = this.base.getContext("2d");
      if (!base) return;
      base.scale(window.devicePixelRatio || 1, window.devicePixelRatio || 1);
      this.draw_base(base, run, width);
      this.base_key = key;
    }
    g.drawImage(this.base, 0, 0, width, height);
    const x = this.x_of(this.session.tick, width);
    g.strokeStyle = theme().text;
    g.lineWidth = 1.5;
    g.beginPath();
    g.moveTo(x, 0);
    g.lineTo(x, height - kAxis + 4);
    g.stroke();
  }

  private draw_base(g: CanvasRenderingContext2D, run: Run, width: number): void {
    const colours = theme();
    g.font = "12px system-ui, sans-serif";
    const lanes = this.lanes(run);
    lanes.forEach((lane, row) => {
      const y = row * kLane;
      g.fillStyle = row % 2 === 0 ? colours.field : colours.ground;
      g.fillRect(kLeft, y, width - kLeft, kLane);
      g.fillStyle = colours.faint;
      g.textAlign = "right";
      g.textBaseline = "middle";
      g.fillText(lane.stage, kLeft - 10, y + kLane / 2);
      this.draw_band(g, run, lane, y, width, colours);
    });
    lanes.forEach((lane, row) => this.draw_marks(g, run, lane, row * kLane + kLane / 2, width, colours));
    this.draw_axis(g, run, lanes.length * kLane, width, colours);
  }

  private draw_band(g: CanvasRenderingContext2D, run: Run, lane: Lane, y: number, width: number, colours: Theme): void {
    const topic = run.recording.topic(lane.topic ?? "");
    if (!topic || topic.length === 0) return;
    const pixels = Math.max(1, Math.round(width - kLeft - 12));
    g.fillStyle = run_colour(colours, run.index);
    const first = this.session.first_tick;
    const span = Math.max(1, this.session.last_tick - first);
    let before = NaN;
    for (let pixel = 0; pixel <= pixels; pixel++) {
      const tick = Math.round(first + (pixel / pixels) * span);
      const index = topic.index_at(tick);
      if (index < 0) continue;
      const shade = this.shade(lane, run, topic.sample(index), index, before);
      if (lane.stage === "plan") before = topic.schema.number(topic.sample(index), "x_m");
      if (shade <= 0) continue;
      g.globalAlpha = Math.min(1, shade);
      g.fillRect(kLeft + pixel - 0.5, y + 3, 1.5, kLane - 6);
    }
    g.globalAlpha = 1;
  }

  private shade(lane: Lane, run: Run, sample: Uint8Array, index: number, before: number): number {
    const topic = run.recording.topic(lane.topic ?? "");
    if (!topic) return 0;
    if (lane.stage === "sense") {
      const farthest = topic.schema.number(sample, "range_max_m");
      let least = farthest;
      for (const range of topic.schema.doubles(sample, "ranges_m") ?? []) least = Math.min(least, range);
      return 0.7 * (1 - least / Math.max(1e-9, farthest));
    }
    const value = topic.schema.number(sample, lane.path ?? "");
    if (lane.stage === "plan") return index > 0 && !Number.isNaN(before) && before !== value ? 0.9 : 0;
    return lane.shade ? lane.shade(value) : 0;
  }

  private draw_marks(g: CanvasRenderingContext2D, run: Run, lane: Lane, y: number, width: number, colours: Theme): void {
    let last_x = -Infinity;
    let last_kind = "";
    for (const event of by_weight(run.events)) {
      if (event.stage !== lane.stage) continue;
      const x = this.x_of(event.tick, width);
      // A mark upon the same one adds nothing.
      if (event.kind === last_kind && x - last_x < 2) continue;
      last_x = x;
      last_kind = event.kind;
      const strong = event.kind === "trap" || event.kind === "collision" || event.kind === "hit";
      draw_mark(g, event.kind, x, y, event.kind === "landmark" ? 3.5 : 5, strong ? colours.trap : colours.text,
        colours.field, event.shadow);
    }
  }

  private draw_axis(g: CanvasRenderingContext2D, run: Run, y: number, width: number, colours: Theme): void {
    const first_s = this.session.first_tick * run.tick_s;
    const last_s = this.session.last_tick * run.tick_s;
    const step = round_up(((last_s - first_s) * 80) / Math.max(1, width - kLeft) || 1);
    g.fillStyle = colours.faint;
    g.strokeStyle = colours.faint;
    g.textAlign = "center";
    g.textBaseline = "top";
    g.font = "11px system-ui, sans-serif";
    for (let time = Math.ceil(first_s / step) * step; time <= last_s + 1e-9; time += step) {
      const x = this.x_of(time / run.tick_s, width);
      g.fillRect(x, y, 1, 4);
      if (x < width - 24) g.fillText(`${Number(time.toFixed(3))} s`, x, y + 5);
    }
  }

  private add_pointer(): void {
    const canvas = this.canvas;
    const scrub = (event: PointerEvent): void => this.session.go_to(this.tick_at(event.offsetX));
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.session.set_playing(false);
      const near = this.nearest(event.offsetX, event.offsetY);
      if (near) this.session.go_to(near.tick);
      else scrub(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons === 1) scrub(event);
      const near = this.nearest(event.offsetX, event.offsetY);
      const lane = this.session.run && this.lanes(this.session.run)[Math.floor(event.offsetY / kLane)];
      canvas.title = near
        ? `tick ${near.tick}: ${kKindNames[near.kind]}${near.shadow ? " (in shadow)" : ""} ${near.rule} ${near.text}`.trim()
        : lane ? `${lane.stage}: ${lane.meaning}` : "";
    });
  }

  private nearest(x: number, y: number): RunEvent | undefined {
    const run = this.session.run;
    const lane = run && this.lanes(run)[Math.floor(y / kLane)];
    if (!run || !lane) return undefined;
    let best: RunEvent | undefined;
    let least = 5;
    for (const event of run.events) {
      const distance = Math.abs(this.x_of(event.tick, this.canvas.clientWidth) - x);
      if (event.stage !== lane.stage || event.kind === "landmark" || distance >= least) continue;
      least = distance;
      best = event;
    }
    return best;
  }
}
