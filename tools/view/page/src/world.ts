// SPDX-License-Identifier: Apache-2.0
// The world and the robot of a run, from the texts that its recording carries.

import { load } from "js-yaml";

export type Point = [number, number];

/// A disc, a polygon or a door.
export interface MovingObstacle {
  radius_m: number;
  /// Of a polygon, from its first one; none: it is no polygon.
  corners: Point[];
  /// A leaf of a door, and its hinge; none: it is no door.
  door: { hinge: Point; length_m: number; turns: [number, number][] } | undefined;
  /// Time and place, by rising time; none of a door.
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

type Node = Record<string, unknown>;
/// Is told, for each kind of thing that is left out, what and why.
export type Complain = (kind: string, text: string) => void;
const nobody: Complain = () => undefined;

/// So many finite numbers at least; nothing if it is anything else.
function numbers(value: unknown, count: number): number[] | undefined {
  if (!Array.isArray(value) || value.length < count) return undefined;
  return value.every((each) => typeof each === "number" && Number.isFinite(each)) ? value as number[] : undefined;
}

/// The entries of a list that can be read; of the others `complain` hears. A list that is not there is empty.
function entries<T>(value: unknown, what: string, read: (entry: unknown) => T | undefined, complain: Complain): T[] {
  if (value === undefined || value === null) return [];
  if (!Array.isArray(value)) {
    complain(what, `${what} of the world: no list; they are left out`);
    return [];
  }
  const found: T[] = [];
  value.forEach((entry, index) => {
    const read_entry = read(entry);
    if (read_entry !== undefined) found.push(read_entry);
    else complain(what, `${what}[${index}] of the world cannot be read: it is left out`);
  });
  return found;
}

const positive = (value: unknown): number => (typeof value === "number" && value > 0 && Number.isFinite(value) ? value : 0);
const quad = (value: unknown): [number, number, number, number] | undefined => numbers(value, 4) as [number, number, number, number] | undefined;
const triple = (value: unknown): [number, number, number] | undefined => numbers(value, 3) as [number, number, number] | undefined;
const point = (value: unknown): Point | undefined => numbers(value, 2) as Point | undefined;

function disc(value: unknown): [number, number, number] | undefined {
  const circle = triple(value);
  return circle && circle[2] > 0 ? circle : undefined;
}

function moving(value: unknown, complain: Complain): MovingObstacle | undefined {
  const { circle, polygon, door, turns, path, loop, jumps } = tree(value);
  const obstacle: MovingObstacle = {
    radius_m: 0, corners: [], door: undefined, path: entries(path, "path of moving", triple, complain), loops: loop === true, jumps: jumps === true,
  };
  const at = disc(circle);
  const leaf = disc(door);
  const corners = entries(polygon, "polygon of moving", point, complain);
  const [first] = corners;
  if (at) obstacle.radius_m = at[2];
  else if (leaf) obstacle.door = { hinge: [leaf[0], leaf[1]], length_m: leaf[2], turns: entries(turns, "turns of moving", point, complain) };
  else if (first) obstacle.corners = corners.map(([x, y]) => [x - first[0], y - first[1]]);
  else return undefined;
  return obstacle;
}

/// The corners of a polygon that can be read.
function shape(value: unknown, complain: Complain): Point[] | undefined {
  return Array.isArray(value) ? entries(value, "corners of polygons", point, complain) : undefined;
}

function tree(value: unknown): Node {
  return value !== null && typeof value === "object" && !Array.isArray(value) ? value as Node : {};
}

/// Nothing of it if it is none of our files, of which `complain` hears: each is a tree.
function parsed(text: string, name: string, complain: Complain): Node {
  let why = "no names with values";
  try {
    const file: unknown = load(text);
    if (file !== null && typeof file === "object" && !Array.isArray(file)) return file as Node;
  } catch (error) {
    why = String(error instanceof Error ? error.message : error).split("\n")[0] ?? "";
  }
  complain(name, `${name} cannot be read (${why}): it is left out`);
  return {};
}

/// What of it is a world; nothing if the text is none.
export function read_world(text: string, complain: Complain = nobody): World | undefined {
  const file = parsed(text, "world.yaml", complain);
  const bounds = quad(file["bounds"]);
  const start = triple(file["start"]);
  const target = point(file["target"]);
  if (!bounds || !start || !target || bounds[2] <= bounds[0] || bounds[3] <= bounds[1]) {
    complain("world.yaml", "world.yaml is no world: it needs bounds [left, bottom, right, top] that rise, a start [x, y, heading] and a target [x, y]; the world is left out");
    return undefined;
  }
  const target_radius_m = positive(file["target_radius"]);
  return {
    name: typeof file["name"] === "string" ? file["name"] : "",
    bounds,
    walls: entries(file["walls"], "walls", quad, complain),
    polygons: entries(file["polygons"], "polygons", (corners) => shape(corners, complain), complain),
    circles: entries(file["circles"], "circles", disc, complain),
    moving: entries(file["moving"], "moving", (each) => moving(each, complain), complain),
    start,
    target,
    target_radius_m,
    waypoints: entries(file["waypoints"], "waypoints", (entry) => {
      const place = Array.isArray(entry) ? point(entry.slice(0, 2)) : undefined;
      return place && { place, radius_m: positive((entry as unknown[])[2]) || target_radius_m };
    }, complain),
  };
}

/// Whether two worlds are those of robots that are about in one room: each has the others as
/// obstacles that jump.
export function same_room(a: World, b: World): boolean {
  const room = ({ bounds, walls, polygons, circles }: World): string => JSON.stringify([bounds, walls, polygons, circles]);
  const has_others = (world: World): boolean => world.moving.some(({ jumps }) => jumps);
  return has_others(a) && has_others(b) && room(a) === room(b);
}

export function read_robot_radius_m(text: string, complain: Complain = nobody): number {
  return positive(parsed(text, "robot.yaml", complain)["radius_m"]) || 0.15;
}

/// A value of the expanded graph: `control.behaviour`, `recover.detector`.
export function read_graph(text: string, complain: Complain = nobody): Record<string, unknown> {
  return parsed(text, "graph.yaml", complain);
}

/// Times of a path that jumps are those of ticks, which are summed up in several ways.
const kJumpTolerance_s = 1e-6;

/// Numbers behind a time, by rising time, as they are at `time_s`.
function between(steps: number[][], time_s: number, loops: boolean, jumps: boolean): number[] {
  const first = steps[0] ?? [0, 0, 0];
  const last = steps[steps.length - 1] ?? first;
  const end_s = last[0] ?? 0;
  let time = jumps ? time_s - kJumpTolerance_s : time_s;
  if (loops && end_s > 0) time %= end_s;
  if (time >= end_s) return last.slice(1);
  for (let i = 1; i < steps.length; i++) {
    const [t0 = 0, ...from] = steps[i - 1] ?? first;
    const [t1 = 0, ...to] = steps[i] ?? last;
    if (time > t1 || (jumps && time === t1)) continue;
    if (jumps) return from;
    const share = t1 > t0 ? (time - t0) / (t1 - t0) : 0;
    return from.map((value, k) => value + share * ((to[k] ?? value) - value));
  }
  return first.slice(1);
}

/// Where a moving obstacle's centre is, or its first corner.
export function place_at(obstacle: MovingObstacle, time_s: number): Point {
  const [x = 0, y = 0] = between(obstacle.path, time_s, obstacle.loops, obstacle.jumps);
  return [x, y];
}

/// The corners that are joined by sides: of a polygon, or hinge and end of a door; none of a disc.
export function corners_at(obstacle: MovingObstacle, time_s: number): Point[] {
  if (obstacle.door) {
    const { hinge: [x, y], length_m, turns } = obstacle.door;
    const [angle = 0] = between(turns, time_s, obstacle.loops, false);
    return [[x, y], [x + length_m * Math.cos(angle), y + length_m * Math.sin(angle)]];
  }
  if (obstacle.corners.length === 0) return [];
  const [x, y] = place_at(obstacle, time_s);
  return obstacle.corners.map(([dx, dy]) => [x + dx, y + dy]);
}
