// SPDX-License-Identifier: Apache-2.0
// What lies on the map, layer by layer, from the ground up.

import { draw_moving } from "./map_moving";
import type { Run, RunEvent } from "./run";
import { draw_mark, run_colour, run_dash } from "./theme";
import type { Theme } from "./theme";
import { thinned } from "./thinned";
import type { Point, World } from "./world";

export const kLayers: [string, string][] = [
  ["grid", "Grid"], ["path", "Path"], ["ahead", "Path still to come"], ["belief", "Believed path"],
  ["scan", "Scan"], ["landmarks", "Landmarks"], ["traps", "Traps and what proves them"],
  ["escapes", "Escapes, reflexes, stops"], ["targets", "Virtual targets"],
  ["obstacles", "Virtual obstacles"], ["moving", "Moving obstacles"], ["insides", "Insides of the chosen tick"],
  ["changes", "Changes and incidents"],
];

/// From the world to the canvas.
export interface View {
  /// Pixels a metre.
  scale: number;
  at(x: number, y: number): Point;
}

export interface Scene {
  g: CanvasRenderingContext2D;
  view: View;
  theme: Theme;
  layers: Set<string>;
  tick: number;
}

/// The least of 1, 2, 5, 10, 20, ... (and tenths of them) that is no less.
export function round_up(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  for (const step of [1, 2, 5, 10]) if (step * power >= value * 0.999999) return step * power;
  return 10 * power;
}

/// `robots`: those that are drawn as such, and not as obstacles of each other.
export function draw_world(scene: Scene, world: World, time_s: number, robots: World[] = []): void {
  const { g, view, theme } = scene;
  const [left, bottom, right, top] = world.bounds;
  const [x, y] = view.at(left, top);
  const width = (right - left) * view.scale;
  const height = (top - bottom) * view.scale;
  g.fillStyle = theme.field;
  g.fillRect(x, y, width, height);
  if (scene.layers.has("grid")) draw_grid(scene, world);
  g.fillStyle = theme.solid;
  g.strokeStyle = theme.wall;
  g.lineJoin = g.lineCap = "round";
  g.lineWidth = Math.max(1.5, Math.min(3, view.scale * 0.04));
  for (const polygon of world.polygons) {
    g.beginPath();
    for (const [px, py] of polygon) g.lineTo(...view.at(px, py));
    g.closePath();
    g.fill();
    g.stroke();
  }
  for (const [cx, cy, radius] of world.circles) disc(scene, [cx, cy], radius, true);
  g.beginPath();
  for (const [x1, y1, x2, y2] of world.walls) {
    g.moveTo(...view.at(x1, y1));
    g.lineTo(...view.at(x2, y2));
  }
  g.stroke();
  g.strokeRect(x, y, width, height);
  if (scene.layers.has("moving")) draw_moving(scene, world, time_s, robots);
}

export function disc(scene: Scene, place: Point, radius_m: number, fill: boolean): void {
  scene.g.beginPath();
  scene.g.arc(...scene.view.at(...place), radius_m * scene.view.scale, 0, 2 * Math.PI);
  if (fill) scene.g.fill();
  scene.g.stroke();
}

function draw_grid(scene: Scene, world: World): void {
  const { g, view, theme } = scene;
  const [left, bottom, right, top] = world.bounds;
  const step = round_up(60 / view.scale);
  g.strokeStyle = theme.grid;
  g.fillStyle = theme.faint;
  g.lineWidth = 1;
  g.font = "10px system-ui, sans-serif";
  g.textBaseline = "top";
  g.textAlign = "center";
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  for (let x = Math.ceil(left / step) * step; x <= right + 1e-9; x += step) {
    g.beginPath();
    g.moveTo(...view.at(x, bottom));
    g.lineTo(...view.at(x, top));
    g.stroke();
    const [px, py] = view.at(x, bottom);
    g.fillText(x.toFixed(digits), px, py + 5);
  }
  g.textBaseline = "middle";
  g.textAlign = "right";
  for (let y = Math.ceil(bottom / step) * step; y <= top + 1e-9; y += step) {
    g.beginPath();
    g.moveTo(...view.at(left, y));
    g.lineTo(...view.at(right, y));
    g.stroke();
    const [px, py] = view.at(left, y);
    g.fillText(y.toFixed(digits), px - 6, py);
  }
  g.textAlign = "left";
  const [px, py] = view.at(right, bottom);
  g.fillText("m", px + 8, py + 9);
}

export function draw_paths(scene: Scene, run: Run): void {
  const { g, view, theme, layers } = scene;
  const drawn = thinned(run, view);
  const now = run.index_at(scene.tick);
  const end = run.ticks.length - 1;
  const colour = run_colour(theme, run.index);
  g.lineJoin = "round";
  g.strokeStyle = colour;
  g.setLineDash(run_dash(run.index));
  if (layers.has("ahead") && now < end) {
    g.globalAlpha = 0.28;
    g.lineWidth = 1.5;
    drawn.ahead.draw(g, view, now, true);
  }
  g.globalAlpha = 1;
  if (layers.has("path")) {
    g.lineWidth = 2;
    drawn.truth.draw(g, view, now);
    // Where an escape was at work the path is twice as wide, with a light core; the dashes tell
    // runs apart there, too.
    g.setLineDash(run_dash(run.index).map((length) => 1.5 * length));
    g.lineWidth = 4.5;
    drawn.recovering.draw(g, view, now);
    g.setLineDash([]);
    g.strokeStyle = theme.field;
    g.lineWidth = 1.5;
    drawn.recovering.draw(g, view, now);
  }
  g.setLineDash([1, 4]);
  if (layers.has("belief")) {
    g.lineWidth = 1.5;
    g.strokeStyle = theme.faint;
    drawn.belief.draw(g, view, now);
  }
  g.setLineDash([]);
}

const kLayerOf: Partial<Record<RunEvent["kind"], string>> = {
  landmark: "landmarks", trap: "traps", virtual_target: "", unreachable: "escapes",
  // The mission says where it is, and the lanes when.
  waypoint: "", change: "changes", incident: "changes", restart: "changes",
};

/// What matters most comes last, on top.
export function by_weight(events: RunEvent[]): RunEvent[] {
  return [...events.filter((event) => event.kind !== "trap"), ...events.filter((event) => event.kind === "trap")];
}

export function draw_events(scene: Scene, run: Run): void {
  const { g, view, theme } = scene;
  const colour = run_colour(theme, run.index);
  for (const event of by_weight(thinned(run, view).events)) {
    if (event.tick > scene.tick || event.kind === "end") continue;
    const layer = kLayerOf[event.kind] ?? "escapes";
    if (layer === "" || !scene.layers.has(layer)) continue;
    const [x, y] = view.at(...event.place);
    const strong = event.kind === "trap" || event.kind === "collision" || event.kind === "hit";
    if (event.kind === "trap" && event.earlier) draw_proof(scene, event, [x, y]);
    draw_mark(g, event.kind, x, y, event.kind === "landmark" ? 4 : 6, strong ? theme.trap : colour, theme.field,
      event.shadow);
  }
}

/// A trap and the earlier visit that proves it, joined.
function draw_proof(scene: Scene, event: RunEvent, [x, y]: Point): void {
  const { g, view, theme } = scene;
  if (!event.earlier) return;
  const [ex, ey] = view.at(...event.earlier.place);
  g.strokeStyle = theme.trap;
  g.lineWidth = 1.4;
  g.setLineDash([4, 3]);
  g.beginPath();
  g.moveTo(x, y);
  g.lineTo(ex, ey);
  g.stroke();
  g.setLineDash([]);
  g.beginPath();
  g.arc(ex, ey, 6, 0, 2 * Math.PI);
  g.fillStyle = theme.field;
  g.fill();
  g.stroke();
}

/// Virtual targets, small, each joined to where it was set; the one in force is large.
export function draw_virtual_targets(scene: Scene, run: Run): void {
  const { g, view, theme } = scene;
  const past = thinned(run, view).virtual_targets.filter((each) => each.tick <= scene.tick);
  const in_force = run.recording.topic("guidance")?.number_at(scene.tick, "target_is_virtual") === 1;
  const newest = in_force ? run.virtual_targets.filter((each) => each.tick <= scene.tick).pop() : undefined;
  for (const each of newest ? [...past.filter((other) => other !== newest), newest] : past) {
    const last = each === newest;
    const [x, y] = view.at(...each.place);
    g.strokeStyle = run_colour(theme, run.index);
    g.globalAlpha = last ? 0.9 : 0.25;
    g.lineWidth = 1;
    g.beginPath();
    g.moveTo(...view.at(...each.from));
    g.lineTo(x, y);
    g.stroke();
    g.globalAlpha = last ? 1 : 0.6;
    draw_mark(g, "virtual_target", x, y, last ? 7 : 3, run_colour(theme, run.index), theme.field);
    g.globalAlpha = 1;
  }
}

interface Box {
  x_min_m: number;
  y_min_m: number;
  x_max_m: number;
  y_max_m: number;
}

export function draw_virtual_obstacles(scene: Scene, run: Run): void {
  const boxes = (run.recording.topic("guidance")?.message_at(scene.tick)?.["virtual_obstacles"] ?? []) as Box[];
  const { g, view, theme } = scene;
  for (const box of boxes) {
    const corners = [[box.x_min_m, box.y_min_m], [box.x_max_m, box.y_min_m], [box.x_max_m, box.y_max_m],
      [box.x_min_m, box.y_max_m]];
    g.beginPath();
    for (const [x, y] of corners) g.lineTo(...view.at(...run.to_world(scene.tick, x ?? 0, y ?? 0)));
    g.closePath();
    g.globalAlpha = 0.18;
    g.fillStyle = theme.trap;
    g.fill();
    g.globalAlpha = 1;
    g.setLineDash([5, 3]);
    g.strokeStyle = theme.trap;
    g.lineWidth = 1.4;
    g.stroke();
    g.setLineDash([]);
  }
}

interface Scan {
  bearing_first_rad: number;
  bearing_step_rad: number;
  beam_width_rad: number;
  range_max_m: number;
  ranges_m: ArrayLike<number>;
}

export function draw_scan(scene: Scene, run: Run): void {
  const scan = run.recording.topic("scan")?.message_at(scene.tick) as unknown as Scan | undefined;
  const pose = run.truth[run.index_at(scene.tick)];
  if (!scan || !pose || run.ticks[run.index_at(scene.tick)] !== scene.tick) return;
  const { g, view, theme } = scene;
  g.lineWidth = 1;
  g.strokeStyle = g.fillStyle = theme.scan;
  const [x, y] = view.at(pose.x, pose.y);
  for (let i = 0; i < scan.ranges_m.length; i++) {
    const range = scan.ranges_m[i] ?? 0;
    const far = range >= scan.range_max_m;
    const angle = -(pose.heading + scan.bearing_first_rad + i * scan.bearing_step_rad);
    const radius = Math.max(0, range + run.radius_m) * view.scale;
    g.globalAlpha = far ? 0.08 : 0.28;
    if (scan.beam_width_rad > 0) {
      g.beginPath();
      g.moveTo(x, y);
      g.arc(x, y, radius, angle - scan.beam_width_rad / 2, angle + scan.beam_width_rad / 2);
      g.closePath();
      g.fill();
    } else {
      g.beginPath();
      g.moveTo(x, y);
      g.lineTo(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
      g.stroke();
    }
    if (far) continue;
    g.globalAlpha = 1;
    g.beginPath();
    g.lineWidth = 2;
    const half = Math.max(scan.beam_width_rad / 2, 2 / Math.max(radius, 1));
    g.arc(x, y, radius, angle - half, angle + half);
    g.stroke();
    g.lineWidth = 1;
  }
  g.globalAlpha = 1;
}

/// Where a run would begin.
export function draw_start(scene: Scene, world: World): void {
  const { g, view, theme } = scene;
  const [x, y, heading] = world.start;
  const [px, py] = view.at(x, y);
  g.strokeStyle = theme.text;
  g.fillStyle = theme.field;
  g.lineWidth = 2;
  g.beginPath();
  g.arc(px, py, Math.max(5, 0.15 * view.scale), 0, 2 * Math.PI);
  g.fill();
  g.moveTo(px, py);
  g.lineTo(px + 0.3 * view.scale * Math.cos(heading), py - 0.3 * view.scale * Math.sin(heading));
  g.stroke();
}

/// With its number where there are several: robots have one shape. `nth`: among those that stand
/// upon each other, whose numbers lie side by side; none: it has no number.
export function draw_robot(scene: Scene, run: Run, nth?: number): void {
  const at = run.index_at(scene.tick);
  const { g, view, theme } = scene;
  const body = (x: number, y: number, heading: number, ghost: boolean): void => {
    const [px, py] = view.at(x, y);
    const radius = Math.max(5, run.radius_m * view.scale);
    g.lineWidth = 2;
    g.strokeStyle = ghost ? theme.faint : run_colour(theme, run.index);
    g.fillStyle = theme.field;
    g.setLineDash(ghost ? [3, 3] : []);
    g.beginPath();
    g.arc(px, py, radius, 0, 2 * Math.PI);
    if (!ghost) g.fill();
    g.stroke();
    g.beginPath();
    g.moveTo(px, py);
    g.lineTo(px + radius * 1.5 * Math.cos(heading), py - radius * 1.5 * Math.sin(heading));
    g.stroke();
    g.setLineDash([]);
  };
  const belief = run.belief[at];
  const truth = run.truth[at];
  if (belief && scene.layers.has("belief")) body(belief.x, belief.y, belief.heading, true);
  if (!truth) return;
  body(truth.x, truth.y, truth.heading, false);
  if (nth !== undefined) draw_number(scene, run, nth, view.at(truth.x, truth.y));
}

function draw_number({ g, view, theme }: Scene, run: Run, nth: number, [x, y]: Point): void {
  const away = Math.max(5, run.radius_m * view.scale) + 7;
  const at: Point = [x + away + 12 * nth, y - away];
  g.font = "700 12px system-ui, sans-serif";
  g.textAlign = "center";
  g.textBaseline = "middle";
  g.lineWidth = 3;
  g.strokeStyle = theme.field;
  g.strokeText(String(run.index + 1), ...at);
  g.fillStyle = run_colour(theme, run.index);
  g.fillText(String(run.index + 1), ...at);
}
