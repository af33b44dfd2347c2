// SPDX-License-Identifier: Apache-2.0
// Where robots are sent, on the map.

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

/// The number of a robot below the place where it goes.
function name_target({ g, view, theme }: Scene, { place, radius_m }: Waypoint, run: Run, nth: number): void {
  const [x, y] = view.at(...place);
  const below = 1.7 * Math.max(5, radius_m * view.scale) + 8;
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
    g.lineTo(x + (dx ?? 0) * radius * 1.7, y + (dy ?? 0) * radius * 1.7);
  }
  g.stroke();
}
