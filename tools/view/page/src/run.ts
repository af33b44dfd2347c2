// SPDX-License-Identifier: Apache-2.0
// What the page shows of a run, followed tick by tick as samples arrive: the path, true and
// believed, and the events of each stage.

import { Progress, first_mission, mission_of_change } from "./missions";
import type { Change, Incident, Recording } from "./recording";
import { read_graph, read_robot_radius_m, read_world } from "./world";
import type { Complain, Point, World } from "./world";

export type EventKind =
  | "landmark" | "reflex" | "trap" | "escape_begun" | "escape_ended" | "escape_failed"
  | "virtual_target" | "unreachable" | "collision" | "hit" | "safety_stop" | "late" | "end"
  | "waypoint" | "change" | "incident" | "restart";

/// Something that happened, at a place of the world.
export interface RunEvent {
  tick: number;
  stage: string;
  kind: EventKind;
  rule: string;
  text: string;
  shadow: boolean;
  place: Point;
  earlier?: { tick: number; place: Point };
}

interface EventEntry {
  kind: number;
  shadow: boolean;
  rule: string;
  x_m: number;
  y_m: number;
  has_earlier: boolean;
  earlier_tick: bigint;
  earlier_x_m: number;
  earlier_y_m: number;
  travel_m: number;
  text: string;
}

/// In the order of idl/Event.idl.
const kKinds: EventKind[] = [
  "landmark", "reflex", "trap", "escape_begun", "escape_ended", "escape_failed", "virtual_target",
  "unreachable",
];
export const kOutcomes = ["running", "reached", "collided", "unreachable", "timeout"];

export interface Pose {
  x: number;
  y: number;
  heading: number;
}

export class Run {
  readonly ticks: number[] = [];
  readonly truth: Pose[] = [];
  readonly belief: (Pose | undefined)[] = [];
  /// The mode of the guidance: 0 seek, 1 recover, 2 unreachable.
  readonly mode: number[] = [];
  readonly events: RunEvent[] = [];
  /// Where each virtual target was set.
  readonly virtual_targets: { tick: number; place: Point; from: Point }[] = [];
  world: World | undefined;
  radius_m = 0.15;
  graph: Record<string, unknown> = {};
  outcome = "running";
  /// Its number at the server; nothing in a report.
  served: number | undefined;
  private has_texts = false;
  private counts = [0, 0, 0];
  /// Where it was sent, and how far it came.
  readonly progress = new Progress();
  /// Whether something was done to it, or befell it, that is no stage's.
  has_run_events = false;
  private changes_taken = 0;
  private incidents_taken = 0;
  private target: Point | undefined;

  constructor(public recording: Recording, readonly index: number) {}

  /// Begins anew with another recording of the same run.
  restart(recording: Recording): void {
    this.recording = recording;
    for (const list of [this.ticks, this.truth, this.belief, this.mode, this.events, this.virtual_targets]) list.length = 0;
    this.counts = [0, 0, 0];
    this.target = undefined;
    this.outcome = "running";
    this.changes_taken = this.incidents_taken = 0;
    this.has_run_events = false;
    this.progress.clear();
    this.begin_mission();
  }

  get tick_s(): number {
    return this.recording.tick_s;
  }
  get first_tick(): number {
    return this.ticks[0] ?? 0;
  }
  get last_tick(): number {
    return this.ticks[this.ticks.length - 1] ?? 0;
  }

  /// The place of a tick in the lists, or of the nearest one that is there.
  index_at(tick: number): number {
    const guess = Math.max(0, Math.min(this.ticks.length - 1, tick - this.first_tick));
    if (this.ticks[guess] === tick || tick <= this.first_tick || tick >= this.last_tick) {
      return tick >= this.last_tick ? this.ticks.length - 1 : guess;
    }
    // A run that is watched has ticks in between that were not passed on.
    let low = 0;
    let high = this.ticks.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if ((this.ticks[middle] ?? 0) <= tick) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /// Takes in what has arrived since the last call, for `budget_ms` at most. True if more waits.
  follow(budget_ms: number): boolean {
    this.read_texts();
    const states = this.recording.topic("state");
    if (!states) return false;
    const until = performance.now() + budget_ms;
    // A tick is whole once a sample of the next one is there, or nothing more will come.
    while (this.ticks.length < states.length) {
      this.take_whole(states.ticks[this.ticks.length] ?? 0, this.ticks.length);
      if (this.ticks.length % 64 === 0 && performance.now() > until) return this.ticks.length < states.length;
    }
    this.take_incidents();
    return false;
  }

  /// A place of the odometry's frame in the world, as the poses of that tick tell.
  to_world(tick: number, x: number, y: number): Point {
    const at = this.index_at(tick);
    const truth = this.truth[at];
    const belief = this.belief[at];
    if (!truth || !belief) return [x, y];
    const turn = truth.heading - belief.heading;
    const dx = x - belief.x;
    const dy = y - belief.y;
    return [
      truth.x + Math.cos(turn) * dx - Math.sin(turn) * dy,
      truth.y + Math.sin(turn) * dx + Math.cos(turn) * dy,
    ];
  }

  private read_texts(): void {
    const { bundle } = this.recording;
    const [graph, world, robot] = ["graph.yaml", "world.yaml", "robot.yaml"].map((name) => bundle.get(name));
    if (this.has_texts || graph === undefined) return;
    // All texts come before the first sample, but perhaps not in one piece.
    if ((world === undefined || robot === undefined) && !this.recording.topic("state")?.length) return;
    const complain: Complain = (kind, text) => this.recording.complain(kind, text);
    this.graph = read_graph(graph, complain);
    if (world !== undefined) this.world = read_world(world, complain);
    if (robot !== undefined) this.radius_m = read_robot_radius_m(robot, complain);
    this.has_texts = true;
    this.begin_mission();
  }

  private begin_mission(): void {
    const [x, y] = this.world?.start ?? [0, 0];
    if (this.world) this.progress.begin(first_mission(this.world, this.graph), [x, y]);
  }

  /// What holds from this tick on. A change of the goal is the drive's, one of a behaviour its stage's.
  private take_changes(tick: number): void {
    const { changes } = this.recording;
    for (let change = changes[this.changes_taken]; change && change.tick <= tick; change = changes[this.changes_taken]) {
      // Whatever becomes of it: not again.
      this.changes_taken++;
      const before = this.truth[this.truth.length - 1];
      const place: Point = before ? [before.x, before.y] : [this.world?.start[0] ?? 0, this.world?.start[1] ?? 0];
      const mission = this.world && mission_of_change(change, this.world);
      if (mission) this.progress.begin(mission, place);
      this.add(change.tick, stage_of_change(change), "change", place, change.order || change.changes.join(", "));
    }
  }

  /// They may come late: nobody waits for them.
  private take_incidents(): void {
    const { incidents } = this.recording;
    for (; this.incidents_taken < incidents.length; this.incidents_taken++) {
      const incident = incidents[this.incidents_taken];
      const pose = incident && this.truth[this.index_at(incident.tick)];
      if (!incident || !pose) return;
      this.add(incident.tick, this.stage_of_incident(incident), incident.kind === "restart" ? "restart" : "incident", [pose.x, pose.y],
        incident.text, incident.kind);
    }
  }

  private stage_of_incident(incident: Incident): string {
    return incident.stage in this.graph ? incident.stage : "run";
  }

  /// All that came with a tick. What of it cannot be read is left out, and the ticks behind it are read.
  private take_whole(tick: number, index: number): void {
    for (const work of [() => this.take_changes(tick), () => this.take(tick, index)]) {
      try {
        work();
      } catch (error) {
        const why = error instanceof Error ? error.message : String(error);
        this.recording.complain("tick", `tick ${tick} cannot be read whole (${why}): what cannot is left out`);
      }
    }
  }

  /// A sample whose first number is not there is none; one that the topic has not is none to complain of.
  private check(topic_name: string, tick: number, first: number): void {
    const topic = Number.isNaN(first) ? this.recording.topic(topic_name) : undefined;
    const index = topic?.index_at(tick) ?? -1;
    // It tells the recording itself.
    if (index >= 0) topic?.message(index);
  }

  private take(tick: number, index: number): void {
    const number = (topic: string, path: string): number => this.recording.topic(topic)?.number_at(tick, path) ?? NaN;
    const pose = (topic: string, path: string): Pose => ({
      x: number(topic, `${path}.x_m`), y: number(topic, `${path}.y_m`), heading: number(topic, `${path}.heading_rad`),
    });
    // Each list has its place of the tick, whatever else there is.
    this.ticks.push(tick);
    this.truth.push({ x: NaN, y: NaN, heading: NaN });
    this.belief.push(undefined);
    this.mode.push(0);
    const truth = this.truth[index] = pose("state", "pose_world_robot");
    const belief = pose("odometry", "pose_odom_robot");
    if (!Number.isNaN(belief.x)) this.belief[index] = belief;
    const mode = number("guidance", "mode");
    if (!Number.isNaN(mode)) this.mode[index] = mode;
    this.check("state", tick, truth.x);
    this.check("odometry", tick, belief.x);
    this.check("guidance", tick, mode);
    this.check("target", tick, number("target", "x_m"));
    this.take_state(tick, [truth.x, truth.y], number);
    this.take_guidance(tick, [truth.x, truth.y], number);
    this.take_entries(tick);
  }

  private add(tick: number, stage: string, kind: EventKind, place: Point, text = "", rule = ""): void {
    this.events.push({ tick, stage, kind, rule, text, shadow: false, place });
    if (stage === "run") this.has_run_events = true;
  }

  private take_state(tick: number, place: Point, number: (topic: string, path: string) => number): void {
    const kinds: EventKind[] = ["safety_stop", "collision", "hit"];
    ["safety_stops", "collisions", "hit_by"].forEach((name, i) => {
      const count = number("state", name);
      if (count > (this.counts[i] ?? 0)) this.add(tick, "drive", kinds[i] ?? "collision", place);
      this.counts[i] = count;
    });
    if (number("state", "command_late") === 1) this.add(tick, "drive", "late", place, "the command came too late");
    const outcome = kOutcomes[number("state", "outcome")] ?? "running";
    const [x, y] = place;
    const next = { number: number("target", "waypoint"), of: number("target", "waypoints") };
    for (const { number: reached, of } of this.progress.see(tick, { x, y, heading: 0 }, next, outcome === "reached")) {
      this.add(tick, "drive", "waypoint", place, `${reached} of ${of}`);
    }
    if (outcome !== "running" && this.outcome === "running") this.add(tick, "drive", "end", place, outcome);
    this.outcome = outcome;
  }

  private take_guidance(tick: number, from: Point, number: (topic: string, path: string) => number): void {
    if (number("guidance", "target_is_virtual") !== 1) {
      this.target = undefined;
      return;
    }
    const target: Point = [number("guidance", "target_x_m"), number("guidance", "target_y_m")];
    if (this.target && this.target[0] === target[0] && this.target[1] === target[1]) return;
    this.target = target;
    this.virtual_targets.push({ tick, place: this.to_world(tick, target[0], target[1]), from });
  }

  private take_entries(tick: number): void {
    const topic = this.recording.topic("event");
    const index = topic?.index_at(tick) ?? -1;
    // A stamp, and no entry: nothing to decode in nearly every tick.
    if (!topic || index < 0 || topic.sample(index).length <= 32) return;
    const message = topic.message(index);
    for (const entry of (message?.["entries"] ?? []) as EventEntry[]) {
      const kind = kKinds[entry.kind] ?? "reflex";
      const event: RunEvent = {
        tick, stage: kind === "landmark" ? "classify" : "recover", kind, rule: entry.rule, text: entry.text,
        shadow: entry.shadow, place: this.to_world(tick, entry.x_m, entry.y_m),
      };
      if (entry.has_earlier) {
        const earlier = Number(entry.earlier_tick);
        event.earlier = { tick: earlier, place: this.to_world(earlier, entry.earlier_x_m, entry.earlier_y_m) };
      }
      this.events.push(event);
    }
  }
}

/// `recover.detector=none` is recover's; a new goal is the drive's; pause and pace are the run's.
function stage_of_change(change: Change): string {
  const first = change.changes[0];
  if (first === undefined) return "run";
  return first.startsWith("goal=") ? "drive" : first.slice(0, first.search(/[.=]/));
}
