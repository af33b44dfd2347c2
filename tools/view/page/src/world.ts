// SPDX-License-Identifier: Apache-2.0
// The world and the robot of a run, from the texts that its recording carries.

import { load } from "js-yaml";

export type Point = [number, number];

export interface MovingObstacle {
  radius_m: number;
  /// Time and place, by rising time.
  path: [number, number, number][];
  loops: boolean;
  /// It stands at each point until after the time of the next, and is there at once.
  jumps: boolean;
}

export interface World {
  name: string;
  bounds: [number, number, number, number];
  walls: [number, number, number, number][];
  polygons: Point[][];
  circles: [number, number, number][];
  moving: MovingObstacle[];
  start: [number, number, number];
  target: Point;
  target_radius_m: number;
  /// Before the target, in their order.
  waypoints: { place: Point; radius_m: number }[];
}

interface WorldFile {
  name?: string;
  bounds?: [number, number, number, number];
  walls?: [number, number, number, number][];
  polygons?: Point[][];
  circles?: [number, number, number][];
  moving?: {
    circle: [number, number, number]; path: [number, number, number][]; loop?: boolean; jumps?: boolean;
  }[];
  start?: [number, number, number];
  target?: Point;
  target_radius?: number;
  waypoints?: number[][];
}

/// Nothing if the text is no world.
export function read_world(text: string): World | undefined {
  let file: WorldFile | undefined;
  try {
    file = load(text) as WorldFile | undefined;
  } catch {
    return undefined;
  }
  if (!file?.bounds || !file.start || !file.target) return undefined;
  return {
    name: file.name ?? "",
    bounds: file.bounds,
    walls: file.walls ?? [],
    polygons: file.polygons ?? [],
    circles: file.circles ?? [],
    moving: (file.moving ?? []).map((each) => (
      { radius_m: each.circle[2], path: each.path, loops: each.loop === true,
        jumps: each.jumps === true })),
    start: file.start,
    target: file.target,
    target_radius_m: file.target_radius ?? 0,
    waypoints: (file.waypoints ?? []).map(([x = 0, y = 0, radius]) => ({ place: [x, y], radius_m: radius ?? file.target_radius ?? 0 })),
  };
}

/// Whether two worlds are those of robots that are about in one room: each has the others as
/// obstacles that jump.
export function same_room(a: World, b: World): boolean {
  const room = ({ bounds, walls, polygons, circles }: World): string => JSON.stringify([bounds, walls, polygons, circles]);
  const has_others = (world: World): boolean => world.moving.some(({ jumps }) => jumps);
  return has_others(a) && has_others(b) && room(a) === room(b);
}

export function read_robot_radius_m(text: string): number {
  try {
    return (load(text) as { radius_m?: number } | undefined)?.radius_m ?? 0.15;
  } catch {
    return 0.15;
  }
}

/// A value of the expanded graph: `control.behaviour`, `recover.detector`.
export function read_graph(text: string): Record<string, unknown> {
  try {
    return (load(text) as Record<string, unknown> | undefined) ?? {};
  } catch {
    return {};
  }
}

/// Times of a path that jumps are those of ticks, which are summed up in several ways.
const kJumpTolerance_s = 1e-6;

/// Where a moving obstacle's centre is.
export function place_at(obstacle: MovingObstacle, time_s: number): Point {
  const path = obstacle.path;
  const first = path[0] ?? [0, 0, 0];
  const last = path[path.length - 1] ?? first;
  let time = obstacle.jumps ? time_s - kJumpTolerance_s : time_s;
  if (obstacle.loops && last[0] > 0) time %= last[0];
  if (time >= last[0]) return [last[1], last[2]];
  for (let i = 1; i < path.length; i++) {
    const [t0, x0, y0] = path[i - 1] ?? first;
    const [t1, x1, y1] = path[i] ?? last;
    if (time > t1 || (obstacle.jumps && time === t1)) continue;
    if (obstacle.jumps) return [x0, y0];
    const share = t1 > t0 ? (time - t0) / (t1 - t0) : 0;
    return [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
  }
  return [first[1], first[2]];
}
