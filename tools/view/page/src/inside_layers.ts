// SPDX-License-Identifier: Apache-2.0
// What components tell of a tick, as far as it has a place: layers over the map, with a legend in
// which each can be switched off. Two layers of one kind differ by shape or hatching as well as by
// colour, and keep both from tick to tick.

import { by_id, element, fit_canvas } from "./elements";
import { shade } from "./inside_drawings";
import type { LayerKind, PictureLayer } from "./inside_values";
import type { Scene, View } from "./map_layers";
import type { Run } from "./run";
import type { Told } from "./server";
import { theme } from "./theme";
import type { Theme } from "./theme";
import type { Point } from "./world";

/// What was told of a tick of a run.
export interface ToldTick {
  run: Run;
  tick: number;
  told: Told;
}

interface NamedLayer {
  key: string;
  /// Which of its kind it is.
  order: number;
  layer: PictureLayer;
}

/// By order: dots, squares, triangles, crosses, diamonds.
const kShapes: Point[][] = [
  [], [[-1, -1], [1, -1], [1, 1], [-1, 1]], [[0, -1.2], [1.1, 0.9], [-1.1, 0.9]], [[-1, -1], [1, 1], [0, 0], [1, -1], [-1, 1], [0, 0]],
  [[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]],
];
const kDashes: number[][] = [[], [7, 4], [2, 4], [9, 3, 2, 3]];
/// Of cells that are blocked: the slopes of their hatching.
const kSlopes: number[][] = [[1], [-1], [1, -1], [0]];
const kHatch_px = 5;

function colour_of(colours: Theme, order: number): string {
  return colours.layers[order % colours.layers.length] ?? colours.accent;
}

export class InsideLayers {
  private readonly legend = element("div", { id: "map-legend", role: "group", "aria-label": "Layers that components tell of" });
  private readonly off = new Set<string>();
  private readonly order_of = new Map<string, number>();
  private readonly known = new Map<LayerKind, number>();
  private shown: ToldTick | undefined;

  constructor(private readonly redraw: () => void) {
    by_id("map").append(this.legend);
  }

  /// What is drawn from now on; nothing: no layer.
  show(told: ToldTick | undefined): void {
    this.shown = told;
    const layers = this.layers;
    const keys = [theme().dark, ...layers.map(({ key }) => key)].join("\n");
    if (this.legend.dataset["keys"] === keys) return;
    this.legend.dataset["keys"] = keys;
    this.legend.replaceChildren(...layers.map((each) => this.entry(each)));
  }

  get shown_tick(): ToldTick | undefined {
    return this.shown;
  }

  private get layers(): NamedLayer[] {
    const layers: NamedLayer[] = [];
    for (const { stage, picture } of this.shown?.told.stages ?? []) {
      for (const layer of picture ?? []) {
        const key = `${stage}: ${layer.name}`;
        layers.push({ key, layer, order: this.order(key, layer.kind) });
      }
    }
    return layers;
  }

  private order(key: string, kind: LayerKind): number {
    let order = this.order_of.get(key);
    if (order === undefined) {
      order = this.known.get(kind) ?? 0;
      this.known.set(kind, order + 1);
      this.order_of.set(key, order);
    }
    return order;
  }

  private entry({ key, order, layer }: NamedLayer): HTMLElement {
    const box = element("input", { type: "checkbox", "data-inside-layer": key });
    box.checked = !this.off.has(key);
    box.addEventListener("change", () => {
      if (box.checked) this.off.delete(key);
      else this.off.add(key);
      this.redraw();
    });
    const swatch = element("canvas", { "aria-hidden": "true" });
    requestAnimationFrame(() => draw_swatch(swatch, layer.kind, order, theme()));
    return element("label", { title: `What ${key.replace(": ", " tells: ")}` }, box, swatch, layer.name);
  }

  /// What lies below the path: areas.
  draw_areas(scene: Scene): void {
    this.each(scene, ({ layer, order }, at) => {
      if (layer.kind === "values") draw_values(scene.g, layer, order, at);
      if (layer.kind === "blocked") draw_blocked(scene.g, layer, order, scene.theme, at);
    });
  }

  /// What lies over it: ways and places.
  draw_places(scene: Scene): void {
    this.each(scene, ({ layer, order }, at) => {
      const places = layer.places.map((place) => at(place));
      if (layer.kind === "way") draw_way(scene.g, places, order, scene.theme);
      if (layer.kind === "points") for (const place of places) draw_point(scene.g, place, order, scene.theme, places.length > 40 ? 1.8 : 3);
      if (layer.kind === "goal") for (const place of places) draw_goal(scene.g, place, order, scene.theme);
    });
  }

  private each(scene: Scene, draw: (layer: NamedLayer, at: (place: Point) => Point) => void): void {
    const shown = this.shown;
    if (!shown || shown.tick !== scene.tick || !scene.layers.has("insides")) return;
    const at = pixel_of(shown, scene.view);
    for (const each of this.layers) if (!this.off.has(each.key)) draw(each, at);
  }
}

/// From the frame of odometry, in which components think, to the canvas.
function pixel_of({ run, tick }: ToldTick, view: View): (place: Point) => Point {
  return ([x, y]) => view.at(...run.to_world(tick, x, y));
}

function trace(g: CanvasRenderingContext2D, corners: Point[]): void {
  g.beginPath();
  for (const [x, y] of corners) g.lineTo(x, y);
  g.closePath();
}

function draw_values(g: CanvasRenderingContext2D, layer: PictureLayer, order: number, at: (place: Point) => Point): void {
  g.globalAlpha = 0.62;
  for (const { corners, value } of layer.cells) {
    g.fillStyle = shade(value, order);
    trace(g, corners.map(at));
    g.fill();
  }
  g.globalAlpha = 1;
}

/// Cells that may not be entered: hatched, so that they are told from values in grey, too.
function draw_blocked(g: CanvasRenderingContext2D, layer: PictureLayer, order: number, colours: Theme, at: (place: Point) => Point): void {
  g.save();
  g.beginPath();
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const { corners } of layer.cells) {
    corners.map(at).forEach(([x, y], i) => {
      if (i === 0) g.moveTo(x, y);
      else g.lineTo(x, y);
      [left, top, right, bottom] = [Math.min(left, x), Math.min(top, y), Math.max(right, x), Math.max(bottom, y)];
    });
    g.closePath();
  }
  g.fillStyle = colour_of(colours, order);
  g.globalAlpha = 0.22;
  g.fill();
  g.clip();
  g.globalAlpha = 0.9;
  // Only what is on the canvas: somebody may have zoomed in.
  hatch(g, Math.max(left, 0), Math.max(top, 0), Math.min(right, g.canvas.clientWidth), Math.min(bottom, g.canvas.clientHeight), order, colours);
  g.restore();
}

function hatch(g: CanvasRenderingContext2D, left: number, top: number, right: number, bottom: number, order: number, colours: Theme): void {
  if (left >= right || top >= bottom) return;
  g.strokeStyle = colour_of(colours, order);
  g.lineWidth = 1;
  g.beginPath();
  for (const slope of kSlopes[order % kSlopes.length] ?? []) {
    const height = bottom - top;
    // Lines of the whole canvas, so that they stay where they are when an area grows.
    const [from, to] = [slope > 0 ? left + top : left - bottom, slope > 0 ? right + bottom : right - top];
    for (let c = Math.ceil((slope === 0 ? top : from) / kHatch_px) * kHatch_px; c <= (slope === 0 ? bottom : to); c += kHatch_px) {
      if (slope === 0) {
        g.moveTo(left, c);
        g.lineTo(right, c);
      } else if (slope > 0) {
        g.moveTo(c - top, top);
        g.lineTo(c - top - height, bottom);
      } else {
        g.moveTo(c + top, top);
        g.lineTo(c + bottom, bottom);
      }
    }
  }
  g.stroke();
}

function draw_way(g: CanvasRenderingContext2D, places: Point[], order: number, colours: Theme): void {
  g.lineJoin = "round";
  for (const [width, colour, dash] of [[4.5, colours.field, []], [2.5, colour_of(colours, order), kDashes[order % kDashes.length] ?? []]] as [number, string, number[]][]) {
    g.lineWidth = width;
    g.strokeStyle = colour;
    g.setLineDash(dash);
    g.beginPath();
    for (const [x, y] of places) g.lineTo(x, y);
    g.stroke();
  }
  g.setLineDash([]);
}

function draw_point(g: CanvasRenderingContext2D, [x, y]: Point, order: number, colours: Theme, size: number): void {
  const shape = kShapes[order % kShapes.length] ?? [];
  g.beginPath();
  if (shape.length === 0) g.arc(x, y, size, 0, 2 * Math.PI);
  else for (const [dx, dy] of shape) g.lineTo(x + dx * size, y + dy * size);
  g.closePath();
  g.fillStyle = g.strokeStyle = colour_of(colours, order);
  g.lineWidth = 1;
  g.fill();
  g.stroke();
}

/// A place to go to: its shape in a ring.
function draw_goal(g: CanvasRenderingContext2D, place: Point, order: number, colours: Theme, radius = 7): void {
  g.beginPath();
  g.arc(place[0], place[1], radius, 0, 2 * Math.PI);
  g.fillStyle = colours.field;
  g.fill();
  g.strokeStyle = colour_of(colours, order);
  g.lineWidth = 2;
  g.stroke();
  draw_point(g, place, order, colours, radius / 3);
}

function draw_swatch(canvas: HTMLCanvasElement, kind: LayerKind, order: number, colours: Theme): void {
  const { g, width, height } = fit_canvas(canvas);
  const middle: Point = [width / 2, height / 2];
  const box: Point[] = [[0, 0], [width, 0], [width, height], [0, height]];
  const as_is = (place: Point): Point => place;
  if (kind === "values") {
    for (let i = 0; i < 5; i++) {
      g.fillStyle = shade(i / 4, order);
      g.fillRect(i * width / 5, 0, width / 5 + 0.5, height);
    }
  } else if (kind === "blocked") {
    draw_blocked(g, { name: "", kind, places: [], cells: [{ corners: box, value: 0 }] }, order, colours, as_is);
  } else if (kind === "way") {
    draw_way(g, [[0, height / 2], [width, height / 2]], order, colours);
  } else if (kind === "goal") {
    draw_goal(g, middle, order, colours, height / 2 - 1);
  } else {
    draw_point(g, middle, order, colours, 3);
  }
}
