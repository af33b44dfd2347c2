// SPDX-License-Identifier: Apache-2.0
// What moves in a world by itself, on the map: discs, polygons, and doors that turn.

import { disc } from "./map_layers";
import type { Scene } from "./map_layers";
import { corners_at, place_at } from "./world";
import type { MovingObstacle, Point, World } from "./world";

/// How thick the sides of a moving shape are.
const kSide_m = 0.04;

/// `robots`: those that are drawn as such, and not as obstacles of each other.
export function draw_moving(scene: Scene, world: World, time_s: number, robots: World[]): void {
  const { g, theme } = scene;
  const is_robot = ({ jumps, path }: MovingObstacle): boolean => jumps &&
    robots.some(({ start }) => path[0]?.[1] === start[0] && path[0][2] === start[1]);
  for (const obstacle of world.moving) {
    if (is_robot(obstacle)) continue;
    g.strokeStyle = theme.moving;
    g.lineWidth = 1;
    g.setLineDash([3, 4]);
    draw_way(scene, obstacle);
    g.setLineDash([]);
    g.fillStyle = theme.moving;
    g.strokeStyle = theme.wall;
    g.lineWidth = 1.5;
    const corners = corners_at(obstacle, time_s);
    if (corners.length > 0) draw_sides(scene, corners);
    else disc(scene, place_at(obstacle, time_s), obstacle.radius_m, true);
  }
}

/// Where an obstacle goes, or what a door sweeps. What goes to and fro on one line has one row of dashes.
function draw_way({ g, view }: Scene, { path, door }: MovingObstacle): void {
  if (door) {
    const angles = door.turns.map(([, angle]) => angle);
    g.beginPath();
    if (angles.length > 1) g.arc(...view.at(...door.hinge), door.length_m * view.scale, -Math.max(...angles), -Math.min(...angles));
    g.stroke();
  }
  const legs = new Set<string>();
  for (let i = 1; i < path.length; i++) {
    const ends = [path[i - 1], path[i]].map((each) => view.at(each?.[1] ?? 0, each?.[2] ?? 0));
    const [from, to] = ends.sort(([ax, ay], [bx, by]) => ax - bx || ay - by);
    const leg = `${from} ${to}`;
    if (!from || !to || legs.has(leg)) continue;
    legs.add(leg);
    g.beginPath();
    g.moveTo(...from);
    g.lineTo(...to);
    g.stroke();
  }
}

/// Doors and polygons that move have thick sides, and nothing within.
function draw_sides({ g, view, theme }: Scene, corners: Point[]): void {
  g.beginPath();
  for (const corner of corners) g.lineTo(...view.at(...corner));
  g.closePath();
  g.strokeStyle = theme.wall;
  g.lineWidth = Math.max(4, kSide_m * view.scale);
  g.stroke();
  g.strokeStyle = theme.moving;
  g.lineWidth -= 2;
  g.stroke();
}
