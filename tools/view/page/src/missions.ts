// SPDX-License-Identifier: Apache-2.0
// Where a robot is sent: the way-points of its world or its graph, and those that it was given while
// the run went on. Which of them were reached the topic `target` says; of a recording without it, or
// of a version that did not say so, it follows from where the robot was.

import type { Change } from "./recording";
import type { Pose } from "./run";
import type { Point, World } from "./world";

export interface Waypoint {
  place: Point;
  radius_m: number;
}

/// From a tick on; without a way-point the robot waits.
export interface Mission {
  tick: number;
  waypoints: Waypoint[];
}

/// A way-point that the robot has reached.
export interface Reached {
  number: number;
  of: number;
}

/// What the topic `target` says of a mission: the way-point that the robot is on the way to, from 1,
/// and how many there are.
export interface NextWaypoint {
  number: number;
  of: number;
}

/// The mission in force from a tick on, where the robot was when it was given, and how many of its
/// way-points were reached.
export interface Standing {
  tick: number;
  mission: Mission;
  from: Point;
  passed: number;
}

const kGoalChange = "goal=";

/// `[x, y]`, `[x, y, radius]`, or more behind that; in place of a radius there may be none. Nothing if
/// it is no place.
function waypoint_of(numbers: unknown, radius_m: number): Waypoint | undefined {
  if (!Array.isArray(numbers)) return undefined;
  const [x, y, radius] = numbers.map(Number);
  if (x === undefined || y === undefined || !Number.isFinite(x) || !Number.isFinite(y)) return undefined;
  return { place: [x, y], radius_m: radius !== undefined && radius > 0 && Number.isFinite(radius) ? radius : radius_m };
}

function waypoints_of(list: unknown, radius_m: number): Waypoint[] {
  if (!Array.isArray(list)) return [];
  return list.map((each) => waypoint_of(each, radius_m)).filter((each): each is Waypoint => each !== undefined);
}

/// What is drawn where nobody goes: a world alone.
export function mission_of_world(world: World): Mission {
  return { tick: 0, waypoints: [...world.waypoints, { place: world.target, radius_m: world.target_radius_m }] };
}

/// A graph's own goals go before those of the world.
export function first_mission(world: World, graph: Record<string, unknown>): Mission {
  const { goal, mission } = graph;
  if (goal === "none") return { tick: 0, waypoints: [] };
  const own = Array.isArray(mission) ? waypoints_of(mission, world.target_radius_m) : waypoints_of([goal], world.target_radius_m);
  return own.length > 0 ? { tick: 0, waypoints: own } : mission_of_world(world);
}

/// The mission that a change gives; nothing if it gives none.
export function mission_of_change(change: Change, world: World): Mission | undefined {
  const goal = change.changes.find((each) => each.startsWith(kGoalChange))?.slice(kGoalChange.length);
  if (goal === undefined) return undefined;
  const places = goal === "none" ? [] : goal.split("/").map((place) => place.split(","));
  return { tick: change.tick, waypoints: waypoints_of(places, world.target_radius_m) };
}

/// How far a robot has come on its missions, tick by tick.
export class Progress {
  /// By tick.
  private readonly steps: Standing[] = [];
  private mission: Mission | undefined;
  private from: Point = [0, 0];
  private passed = 0;
  private last: { tick: number; x: number; y: number } | undefined;

  /// `from`: where the robot is then.
  begin(mission: Mission, from: Point): void {
    this.mission = mission;
    this.from = from;
    this.passed = 0;
    this.last = undefined;
    this.steps.push({ tick: mission.tick, mission, from, passed: 0 });
  }

  clear(): void {
    this.steps.length = this.passed = 0;
    this.mission = this.last = undefined;
  }

  /// Those that are reached at this tick, with this pose; the last one only as the run ends. A mission
  /// of one place has none: the outcome says all of it.
  see(tick: number, pose: Pose, next: NextWaypoint, ends_there: boolean): Reached[] {
    const { mission, from } = this;
    if (!mission || mission.waypoints.length < 2) return [];
    const reached: Reached[] = [];
    const of = mission.waypoints.length;
    const before = this.passed;
    if (next.of === of) {
      this.passed = Math.max(before, Math.min(next.number, of) - 1);
    } else {
      while (this.passed + 1 < of && this.is_at(mission.waypoints[this.passed], tick, pose)) this.passed++;
    }
    if (ends_there) this.passed = of;
    for (let number = before + 1; number <= this.passed; number++) reached.push({ number, of });
    if (reached.length > 0) this.steps.push({ tick, mission, from, passed: this.passed });
    this.last = { tick, x: pose.x, y: pose.y };
    return reached;
  }

  /// What was in force at a tick.
  at(tick: number): Standing | undefined {
    let found: Standing | undefined;
    for (const step of this.steps) {
      if (step.tick > tick) break;
      found = step;
    }
    return found;
  }

  /// Of a run that is watched not every tick is seen: it went straight in between, as far as we know.
  private is_at(waypoint: Waypoint | undefined, tick: number, pose: Pose): boolean {
    if (!waypoint) return false;
    const [x, y] = waypoint.place;
    const { last } = this;
    if (!last || tick - last.tick <= 1) return Math.hypot(pose.x - x, pose.y - y) <= waypoint.radius_m;
    const [dx, dy] = [pose.x - last.x, pose.y - last.y];
    const share = Math.max(0, Math.min(1, ((x - last.x) * dx + (y - last.y) * dy) / (dx * dx + dy * dy || 1)));
    return Math.hypot(last.x + share * dx - x, last.y + share * dy - y) <= waypoint.radius_m;
  }
}
