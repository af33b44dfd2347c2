// SPDX-License-Identifier: Apache-2.0
// Where robots are sent, on the map: their missions, and what the topic `target` says besides.

import type { Scene } from "./map_layers";
import type { Standing, Waypoint } from "./missions";
import type { Run } from "./run";
import { run_colour } from "./theme";

/// Where a robot is sent: way-points in their order, joined, each with its radius and its number,
/// and a tick where it was; the last one is the target.
/// Of several robots, `whose` are named.
export function draw_mission(scene: Scene, { mission, from, passed }: Standing, whose: Run[] = []): void {
  const { g, theme, view } = scene;
  const { waypoints } = mission;
  g.strokeStyle = theme.target;
  if (waypoints.length > 1) {
    g.lineWidth = 1;
    g.setLineDash([2, 4]);
    g.beginPath();
    g.moveTo(...view.at(...from));
    for (const { place } of waypoints) g.lineTo(...view.at(...place));
    g.stroke();
    g.setLineDash([]);
  }
  waypoints.forEach((waypoint, i) => {
    if (i + 1 === waypoints.length) draw_target(scene, waypoint);
    else draw_waypoint(scene, waypoint);
    if (waypoints.length > 1) number_waypoint(scene, waypoint, i + 1, i < passed);
  });
  const target = waypoints[waypoints.length - 1];
  if (target) whose.forEach((run, i) => name_target(scene, target, run, i));
}

/// Where the chosen robot steers for at a tick, where that is a subgoal of the plan on its way: a small
/// square, joined to the robot. And the heading that it is to have there: an arrow between the two
/// bounds that it may have.
export function draw_steering(scene: Scene, run: Run): void {
  const target = run.recording.topic("target")?.message_at(scene.tick) as Steering | undefined;
  const standing = run.progress.at(scene.tick);
  if (!target || !standing || target.waypoint === 0) return;
  const { g, view, theme } = scene;
  g.strokeStyle = theme.target;
  const [x, y] = view.at(...run.to_world(scene.tick, target.x_m, target.y_m));
  const next = standing.mission.waypoints[standing.passed];
  const [goal_x, goal_y] = next ? view.at(...next.place) : [x, y];
  if (is_subgoal(run, scene.tick, target)) draw_subgoal(scene, run, x, y);
  if (target.has_heading !== true) return;
  const truth = run.truth[run.index_at(scene.tick)]?.heading ?? 0;
  const belief = run.belief[run.index_at(scene.tick)]?.heading ?? truth;
  const heading = (target.heading_rad ?? 0) + truth - belief;
  const tolerance = Math.min(Math.PI, target.heading_tolerance_rad ?? 0);
  // Outside of what is drawn of the way-point itself; a target has a cross.
  const is_last = standing.passed + 1 >= standing.mission.waypoints.length;
  const ring = Math.max(5, (next?.radius_m ?? 0) * view.scale) * (is_last ? kCross : 1) + 2;
  const arm = (angle: number, length: number): void => {
    g.moveTo(goal_x + ring * Math.cos(angle), goal_y - ring * Math.sin(angle));
    g.lineTo(goal_x + (ring + length) * Math.cos(angle), goal_y - (ring + length) * Math.sin(angle));
  };
  g.lineWidth = 2;
  g.beginPath();
  arm(heading, kArrow);
  g.stroke();
  draw_arrow_head(g, goal_x + (ring + kArrow) * Math.cos(heading), goal_y - (ring + kArrow) * Math.sin(heading), heading);
  g.lineWidth = 1.5;
  g.setLineDash([2, 3]);
  g.beginPath();
  arm(heading - tolerance, kArrow - 6);
  arm(heading + tolerance, kArrow - 6);
  g.stroke();
  g.setLineDash([]);
}

/// Pixels.
const kArrow = 20;
/// How much longer than its radius the arms of a target's cross are.
const kCross = 1.7;

/// Whether a target is a place that the plan chose on the way to the next way-point.
export function is_subgoal(run: Run, tick: number, target: { x_m: number; y_m: number }): boolean {
  const standing = run.progress.at(tick);
  const next = standing?.mission.waypoints[standing.passed];
  // Without a plan: where odometry is off, way-points of its frame lie a little beside those of the world.
  if (!next || run.graph["plan"] === undefined) return false;
  const [x, y] = run.to_world(tick, target.x_m, target.y_m);
  return Math.hypot(x - next.place[0], y - next.place[1]) > kSubgoal_m;
}

/// Nearer than this it is the way-point itself.
const kSubgoal_m = 0.05;

interface Steering {
  x_m: number;
  y_m: number;
  waypoint?: number;
  has_heading?: boolean;
  heading_rad?: number;
  heading_tolerance_rad?: number;
}

function draw_subgoal({ g, view, theme, tick }: Scene, run: Run, x: number, y: number): void {
  const pose = run.truth[run.index_at(tick)];
  g.lineWidth = 1;
  if (pose) {
    g.setLineDash([1, 3]);
    g.beginPath();
    g.moveTo(...view.at(pose.x, pose.y));
    g.lineTo(x, y);
    g.stroke();
    g.setLineDash([]);
  }
  g.fillStyle = theme.field;
  g.fillRect(x - 4, y - 4, 8, 8);
  g.strokeRect(x - 4, y - 4, 8, 8);
}

function draw_arrow_head(g: CanvasRenderingContext2D, x: number, y: number, heading: number): void {
  g.beginPath();
  for (const side of [-1, 1]) {
    g.moveTo(x, y);
    g.lineTo(x - 8 * Math.cos(heading + side * 0.4), y + 8 * Math.sin(heading + side * 0.4));
  }
  g.stroke();
}

/// The number of a robot below the place where it goes.
function name_target({ g, view, theme }: Scene, { place, radius_m }: Waypoint, run: Run, nth: number): void {
  const [x, y] = view.at(...place);
  const below = kCross * Math.max(5, radius_m * view.scale) + 8;
  g.font = "700 12px system-ui, sans-serif";
  g.textAlign = "center";
  g.textBaseline = "middle";
  g.fillStyle = run_colour(theme, run.index);
  g.fillText(String(run.index + 1), x + 12 * nth, y + below);
}

function draw_waypoint({ g, view, theme }: Scene, { place, radius_m }: Waypoint): void {
  g.strokeStyle = theme.target;
  g.lineWidth = 2;
  g.beginPath();
  g.arc(...view.at(...place), Math.max(5, radius_m * view.scale), 0, 2 * Math.PI);
  g.stroke();
}

/// `2 ✓`: the robot was there.
function number_waypoint({ g, view, theme }: Scene, { place, radius_m }: Waypoint, number: number, reached: boolean): void {
  const [x, y] = view.at(...place);
  const away = 0.75 * Math.max(5, radius_m * view.scale) + 6;
  g.font = "700 12px system-ui, sans-serif";
  g.textAlign = "left";
  g.textBaseline = "middle";
  g.lineWidth = 3;
  g.strokeStyle = theme.field;
  const text = reached ? `${number} ✓` : String(number);
  g.strokeText(text, x + away, y - away);
  g.fillStyle = theme.target;
  g.fillText(text, x + away, y - away);
}

function draw_target({ g, view, theme }: Scene, target: Waypoint): void {
  const [x, y] = view.at(...target.place);
  const radius = Math.max(5, target.radius_m * view.scale);
  g.strokeStyle = theme.target;
  g.lineWidth = 2;
  g.beginPath();
  g.arc(x, y, radius, 0, 2 * Math.PI);
  g.stroke();
  g.beginPath();
  for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
    g.moveTo(x + (dx ?? 0) * radius * 0.4, y + (dy ?? 0) * radius * 0.4);
    g.lineTo(x + (dx ?? 0) * radius * kCross, y + (dy ?? 0) * radius * kCross);
  }
  g.stroke();
}
