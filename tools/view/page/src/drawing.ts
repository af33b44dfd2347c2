// SPDX-License-Identifier: Apache-2.0
// A world drawn on the map: walls by dragging, start and target by a click; or by the keys that
// move a cross on the map.

import { button, element } from "./elements";
import type { MapTool, MapView } from "./map_view";
import type { World } from "./world";
import type { Point } from "./world";

type Part = "wall" | "start" | "target" | "erase";

const kSnap_m = 0.1;
const kSide_m = 10;

const snap = ([x, y]: Point): Point => [Math.round(x / kSnap_m) * kSnap_m, Math.round(y / kSnap_m) * kSnap_m];
const rounded = (value: number): number => Number(value.toFixed(3));

/// As the server takes it.
export interface DrawnWorld {
  bounds: number[];
  walls: number[][];
  start: number[];
  target: number[];
  target_radius: number;
}

export class Drawing implements MapTool {
  readonly box = element("div", { class: "row", id: "drawing" });
  readonly world: World = {
    name: "drawn", bounds: [0, 0, kSide_m, kSide_m], walls: [], polygons: [], circles: [], moving: [],
    start: [5, 1.5, Math.PI / 2], target: [5, 9], target_radius_m: 0.2, waypoints: [],
  };
  private part: Part = "wall";
  private from: Point | undefined;
  private to: Point | undefined;

  /// `begin`: somebody goes on drawing.
  constructor(private readonly map: MapView, begin: () => void) {
    const parts: [Part, string][] = [["wall", "Drag on the map: a wall"], ["start", "Click: where the robot starts; drag for its heading"],
      ["target", "Click: the target"], ["erase", "Click: the nearest wall goes"]];
    for (const [part, title] of parts) {
      const choose = button(part, title, () => {
        begin();
        this.choose(part);
        map.ask_for_place();
      });
      choose.dataset["part"] = part;
      this.box.append(choose);
    }
    this.choose("wall");
  }

  get drawn(): DrawnWorld {
    const { bounds, walls, start, target } = this.world;
    return {
      bounds: [...bounds], walls: walls.map((wall) => wall.map(rounded)), start: start.map(rounded), target: target.map(rounded),
      target_radius: this.world.target_radius_m,
    };
  }

  get drags(): boolean {
    return this.part === "wall" || this.part === "start";
  }

  /// What is being dragged, too.
  get shown(): World {
    if (this.part !== "wall" || !this.from || !this.to) return this.world;
    return { ...this.world, walls: [...this.world.walls, [...this.from, ...this.to]] };
  }

  down(place: Point): void {
    this.from = this.inside(snap(place));
    this.to = this.from;
    if (this.part === "target") this.world.target = this.from;
    if (this.part === "start") this.world.start = [...this.from, this.world.start[2]];
    if (this.part === "erase") this.erase(place);
  }

  move(place: Point): void {
    if (!this.from) return;
    this.to = this.inside(snap(place));
    const [dx, dy] = [this.to[0] - this.from[0], this.to[1] - this.from[1]];
    if (this.part === "start" && Math.hypot(dx, dy) > kSnap_m) this.world.start = [...this.from, Math.atan2(dy, dx)];
  }

  up(): void {
    if (this.part === "wall" && this.from && this.to && Math.hypot(this.to[0] - this.from[0], this.to[1] - this.from[1]) > 1e-9) {
      this.world.walls.push([...this.from, ...this.to]);
    }
    this.from = this.to = undefined;
  }

  private choose(part: Part): void {
    this.part = part;
    for (const each of this.box.querySelectorAll<HTMLElement>("button")) {
      each.setAttribute("aria-pressed", String(each.dataset["part"] === part));
    }
    this.map.draw();
  }

  private inside([x, y]: Point): Point {
    const [left, bottom, right, top] = this.world.bounds;
    return [Math.max(left, Math.min(right, x)), Math.max(bottom, Math.min(top, y))];
  }

  private erase([x, y]: Point): void {
    const distance = ([x1, y1, x2, y2]: [number, number, number, number]): number => {
      const length = (x2 - x1) ** 2 + (y2 - y1) ** 2 || 1;
      const share = Math.max(0, Math.min(1, ((x - x1) * (x2 - x1) + (y - y1) * (y2 - y1)) / length));
      return Math.hypot(x - x1 - share * (x2 - x1), y - y1 - share * (y2 - y1));
    };
    let best = -1;
    this.world.walls.forEach((wall, i) => {
      if (distance(wall) < (best < 0 ? 0.4 : distance(this.world.walls[best] ?? wall))) best = i;
    });
    if (best >= 0) this.world.walls.splice(best, 1);
  }
}
