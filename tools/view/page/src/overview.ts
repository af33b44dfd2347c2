// SPDX-License-Identifier: Apache-2.0
// The first panel: what the run is, what was decided at the chosen tick, and the list of events.

import { element, once_a_frame } from "./elements";
import { names_of } from "./graph_names";
import { is_subgoal } from "./map_goals";
import { kOutcomes } from "./run";
import type { Run, RunEvent } from "./run";
import type { Session } from "./session";
import { kKindNames } from "./theme";

const kModes = ["seek", "recover", "unreachable"];
const kDegrees = 180 / Math.PI;
/// More entries than somebody reads.
const kMostListed = 500;

export class Overview {
  private readonly now = element("dl", { id: "now" });
  private readonly about = element("dl", { id: "about" });
  private readonly events = element("ol", { id: "events" });
  private listed = "";
  private readonly draw = once_a_frame(() => this.draw_now());

  constructor(private readonly session: Session, private readonly panel: HTMLElement) {
    panel.append(
      element("h2", {}, "At this tick"), this.now, element("h2", {}, "Events"), this.events,
      element("h2", {}, "The run"), this.about);
    session.listen(() => this.draw());
  }

  private draw_now(): void {
    const run = this.session.run;
    if (this.panel.hidden || !run || run.ticks.length === 0) return;
    fill(this.now, this.decided(run));
    fill(this.about, about(run));
    this.list_events(run);
  }

  private decided(run: Run): [string, string][] {
    const tick = this.session.tick;
    const message = (topic: string): Record<string, unknown> | undefined => run.recording.topic(topic)?.message_at(tick);
    const at = run.index_at(tick);
    const truth = run.truth[at];
    const belief = run.belief[at];
    const rows: [string, string][] = [];
    if (tick > run.last_tick) rows.push(["", `the run ended at tick ${run.last_tick}`]);
    if (truth) rows.push(["robot", `${truth.x.toFixed(3)}, ${truth.y.toFixed(3)} m, ${(truth.heading * kDegrees).toFixed(1)}°`]);
    if (truth && belief) {
      const off = Math.hypot(truth.x - belief.x, truth.y - belief.y);
      if (off > 1e-9) rows.push(["odometry is off", `${off.toFixed(3)} m`]);
    }
    const landmark = message("landmark") as { spatial_class: number; run_length: number } | undefined;
    if (landmark) rows.push(["spatial class", `${landmark.spatial_class}, for ${landmark.run_length} ticks`]);
    const guidance = message("guidance") as { mode: number; why: string; target_x_m: number; target_y_m: number; target_is_virtual: boolean } | undefined;
    if (guidance) {
      rows.push(["guidance", (kModes[guidance.mode] ?? "?") + (guidance.why ? `: ${guidance.why}` : "")]);
      rows.push([guidance.target_is_virtual ? "virtual target" : "target", `${guidance.target_x_m.toFixed(2)}, ${guidance.target_y_m.toFixed(2)} m`]);
    }
    const now = run.progress.at(tick);
    if (now && now.mission.waypoints.length > 1) rows.push(["way-points reached", `${now.passed} of ${now.mission.waypoints.length}`]);
    const target = message("target") as Target | undefined;
    if (target) rows.push(["sent to", target_text(target, is_subgoal(run, tick, target))]);
    const command = message("command") as { motion: Motion } | undefined;
    if (command) rows.push(["command", motion_text(command.motion)]);
    return rows;
  }

  private list_events(run: Run): void {
    // What befell a run may be told late.
    const events = run.events.filter((event) => event.kind !== "landmark").sort((a, b) => a.tick - b.tick);
    const key = `${run.index} ${events.length}`;
    if (key !== this.listed) {
      this.listed = key;
      this.events.replaceChildren(...events.slice(0, kMostListed).map((event) => this.entry(event)));
      if (events.length === 0) this.events.append(element("li", { class: "faint" }, "none"));
    }
    let past = 0;
    while (past < events.length && (events[past]?.tick ?? 0) <= this.session.tick) past++;
    const current = this.events.children[Math.min(past, kMostListed) - 1];
    if (current?.hasAttribute("aria-current")) return;
    this.events.querySelector("[aria-current]")?.removeAttribute("aria-current");
    current?.setAttribute("aria-current", "true");
  }

  private entry(event: RunEvent): HTMLElement {
    const kind = kKindNames[event.kind];
    // What the kind says already is not said twice.
    const rule = kind.replaceAll(" ", "_").includes(event.rule) ? "" : ` · ${event.rule}`;
    const text = `${kind}${event.shadow ? " (in shadow)" : ""}${rule}`;
    const link = element("button", { type: "button" }, element("b", {}, String(event.tick)), ` ${text}`);
    if (event.text) link.append(element("small", {}, event.text));
    link.addEventListener("click", () => this.session.go_to(event.tick));
    return element("li", { "data-tick": String(event.tick), "data-kind": event.kind }, link);
  }
}

/// As it is recorded; older versions have neither heading nor way-points.
interface Target {
  x_m: number;
  y_m: number;
  has_heading?: boolean;
  heading_rad?: number;
  heading_tolerance_rad?: number;
  waypoint?: number;
  waypoints?: number;
}

function target_text(target: Target, is_on_the_way: boolean): string {
  const { has_heading, heading_rad = 0, heading_tolerance_rad = 0, waypoint, waypoints = 0 } = target;
  if (waypoint === 0) return "nowhere: it waits";
  const end = waypoints > 1 ? `way-point ${waypoint}` : "";
  const way = is_on_the_way ? `${end || "the target"}, by way of ` : end && `${end}: `;
  const heading = has_heading ? `, heading ${(heading_rad * kDegrees).toFixed(0)} ± ${(heading_tolerance_rad * kDegrees).toFixed(0)}°` : "";
  return `${way}${target.x_m.toFixed(2)}, ${target.y_m.toFixed(2)} m${heading}`;
}

interface Motion {
  kind: number;
  turn_rad: number;
  step_m: number;
  speed_mps: number;
  turn_rate_radps: number;
  left_mps: number;
  right_mps: number;
}

function motion_text(motion: Motion): string {
  switch (motion.kind) {
    case 1: return `turn ${(motion.turn_rad * kDegrees).toFixed(1)}°, step ${motion.step_m.toFixed(3)} m`;
    case 2: return `${motion.speed_mps.toFixed(3)} m/s, ${(motion.turn_rate_radps * kDegrees).toFixed(1)}°/s`;
    case 3: return `wheels ${motion.left_mps.toFixed(3)} and ${motion.right_mps.toFixed(3)} m/s`;
    case 4: return "give up";
    default: return "stop";
  }
}

function about(run: Run): [string, string][] {
  const rows: [string, string][] = [["graph", String(run.graph["name"] ?? "")], ["world", run.world?.name ?? ""]];
  for (const stage of ["drive", "sense", "classify", "plan", "recover", "control"]) {
    const part = run.graph[stage] as Record<string, unknown> | undefined;
    if (!part) continue;
    rows.push([stage, stage === "recover" ? `${names_of(part["detector"])} / ${names_of(part["escape"])}` : names_of(part["behaviour"])]);
  }
  const end = run.recording.end;
  rows.push(["outcome", end?.aborted ? `aborted: ${end.aborted}` : kOutcomes.includes(run.outcome) ? run.outcome : ""]);
  rows.push(["ticks", `${run.first_tick} to ${run.last_tick}, ${run.tick_s} s each`]);
  const path = run.recording.topic("state")?.number_at(run.last_tick, "path_length_m");
  if (path !== undefined) rows.push(["path", `${path.toFixed(2)} m`]);
  rows.push(["seed", run.recording.seed], ["hash", end?.hash ?? "not there yet"]);
  if (end && end.lost > 0) rows.push(["lost samples", String(end.lost)]);
  return rows;
}

function fill(list: HTMLElement, rows: [string, string][]): void {
  list.replaceChildren(...rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
}
