// SPDX-License-Identifier: Apache-2.0
// The map: pan by dragging, zoom by the wheel, measure, layers on and off.

import { by_id, button, element, fit_canvas, once_a_frame } from "./elements";
import { InsideLayers } from "./inside_layers";
import type { ToldTick } from "./inside_layers";
import { MapCursor } from "./map_cursor";
import { draw_mission, draw_steering } from "./map_goals";
import {
  draw_events, draw_paths, draw_robot, draw_scan, draw_start, draw_virtual_obstacles, draw_virtual_targets, draw_world, kLayers,
} from "./map_layers";
import type { Scene, View } from "./map_layers";
import { draw_ruler, draw_scale } from "./map_measures";
import { mission_of_world } from "./missions";
import type { Standing } from "./missions";
import type { Run, RunEvent } from "./run";
import type { Session } from "./session";
import { kKindNames, theme } from "./theme";
import { same_room } from "./world";
import type { Point, World } from "./world";

/// Their height: the world is shown below them.
const kButtons = 40;
/// How much smaller the world may be shown for the sake of the legend.
const kLeastBeside = 0.75;

/// What takes the pointer in place of panning, and a world to show in place of the runs'.
export interface MapTool {
  readonly shown: World;
  /// Whether what is pressed is moved until it is let go.
  readonly drags: boolean;
  down(place: Point): void;
  move(place: Point): void;
  up(): void;
}

export class MapView {
  private readonly canvas = by_id<HTMLCanvasElement>("map-canvas");
  private readonly status = by_id("map-status");
  private readonly layers = new Set(kLayers.map(([name]) => name).filter((name) => name !== "belief" && name !== "insides"));
  private readonly inside_layers = new InsideLayers(() => this.draw());
  private scale = 0;
  private centre: Point = [0, 0];
  private measuring = false;
  private ruler: { from: Point; to: Point } | undefined;
  private tool: MapTool | undefined;
  private picker: ((place: Point) => void) | undefined;
  private drag: { x: number; y: number } | undefined;
  private readonly cursor: MapCursor;
  readonly draw = once_a_frame(() => this.draw_now());

  constructor(private readonly session: Session) {
    this.add_controls();
    this.add_pointer();
    this.cursor = new MapCursor(this.canvas, {
      wanted: () => this.measuring || this.tool !== undefined || this.picker !== undefined,
      drags: () => this.measuring || (this.tool?.drags ?? false),
      down: (x, y) => this.press(x, y),
      move: (x, y) => this.move(x, y),
      up: () => this.release(),
    }, () => this.draw());
    session.listen((change) => {
      if (change === "data" || change === "runs") this.fit_if_new();
      this.draw();
    });
    const resized = new ResizeObserver(() => {
      if (this.scale > 0 && this.fitted) this.fit(false);
      this.draw();
    });
    resized.observe(this.canvas);
    resized.observe(this.legend);
  }

  private fitted = true;
  private readonly legend = by_id("map-legend");
  /// What the legend takes of the width. It comes and goes while somebody scrubs; the world stays
  /// beside it.
  private legend_width = 0;

  use(tool: MapTool | undefined): void {
    if (tool === this.tool) return;
    this.tool = tool;
    this.canvas.style.cursor = tool ? "crosshair" : "";
    if (tool || this.scale > 0) this.fit();
    this.draw();
  }

  /// The next click, or Enter, gives a place instead of panning; nothing: it pans again.
  pick(take: ((place: Point) => void) | undefined): void {
    this.picker = take;
    this.canvas.style.cursor = take ? "crosshair" : "";
    if (take) this.ask_for_place();
  }

  /// Keys go to the map, where somebody is to choose a place.
  ask_for_place(): void {
    this.cursor.begin();
    this.status.textContent = "click, or move the cross with the arrow keys and press Enter";
  }

  /// Draws what was told of a tick, if the layer of insides is on.
  show_insides(told: ToldTick | undefined): void {
    this.inside_layers.show(told && this.layers.has("insides") ? told : undefined);
    this.draw();
  }

  /// Switches the layer of insides on, as its box in the menu does.
  want_insides(): void {
    const box = document.querySelector<HTMLInputElement>("[data-layer=insides]");
    if (box && !box.checked) box.click();
  }

  private get world(): World | undefined {
    if (this.tool) return this.tool.shown;
    return this.first?.world;
  }

  /// Where robots are sent at the chosen tick; of a world without a run, its own target.
  private draw_goals(scene: Scene, world: World, shown: Run[]): void {
    const [x, y] = world.start;
    if (shown.length === 0) return draw_mission(scene, { tick: 0, mission: mission_of_world(world), from: [x, y], passed: 0 });
    const ways = new Map<string, { standing: Standing; whose: Run[] }>();
    for (const run of shown) {
      const standing = run.progress.at(this.session.tick);
      if (!standing) continue;
      const key = JSON.stringify(standing.mission.waypoints);
      const way = ways.get(key) ?? { standing, whose: [] };
      ways.set(key, way);
      way.whose.push(run);
    }
    for (const { standing, whose } of ways.values()) draw_mission(scene, standing, ways.size > 1 ? whose : []);
  }

  /// The runs of the shown world, or of its room. A path in another world would mean nothing here.
  private get shown(): Run[] {
    if (this.tool) return [];
    const { first } = this;
    const text = (run: Run | undefined): string | undefined => run?.recording.bundle.get("world.yaml");
    return this.session.shown.filter((run) => text(run) === text(first) ||
      (run.world !== undefined && first?.world !== undefined && same_room(run.world, first.world)));
  }

  /// The run whose world is shown.
  private get first(): Run | undefined {
    const { shown, run } = this.session;
    return shown.find((each) => each === run) ?? shown[0] ?? run;
  }

  private fit_if_new(): void {
    if (this.scale === 0 && this.world) this.fit();
  }

  /// Shows the whole world; beside the legend, if it need not be much smaller for that.
  fit(anew = true): void {
    const world = this.world;
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (!world || width === 0) return;
    const legend_width = this.legend.clientWidth > 0 ? this.legend.clientWidth + 20 : 0;
    this.legend_width = anew ? legend_width : Math.max(this.legend_width, legend_width);
    const [left, bottom, right, top] = world.bounds;
    const scale_in = (room: number): number => Math.min((room - 80) / (right - left), (height - kButtons - 55) / (top - bottom));
    const beside = scale_in(width - this.legend_width) >= kLeastBeside * scale_in(width) ? this.legend_width : 0;
    this.scale = scale_in(width - beside);
    this.centre = [(left + right + beside / this.scale) / 2, (bottom + top) / 2 + (kButtons / 2 - 10) / this.scale];
    this.fitted = true;
    this.draw();
  }

  zoom(factor: number, x = this.canvas.clientWidth / 2, y = this.canvas.clientHeight / 2): void {
    const before = this.place(x, y);
    this.scale = Math.max(0.5, Math.min(5000, this.scale * factor));
    const after = this.place(x, y);
    this.centre = [this.centre[0] + before[0] - after[0], this.centre[1] + before[1] - after[1]];
    this.fitted = false;
    this.draw();
  }

  pan(right_px: number, down_px: number): void {
    this.centre = [this.centre[0] + right_px / this.scale, this.centre[1] - down_px / this.scale];
    this.fitted = false;
    this.draw();
  }

  measure(on = !this.measuring): void {
    this.measuring = on;
    if (!on) this.ruler = undefined;
    by_id("measure").setAttribute("aria-pressed", String(on));
    this.canvas.style.cursor = on ? "crosshair" : "";
    if (on) this.ask_for_place();
    this.draw();
  }

  /// The length of what was measured last, in metres.
  get measured(): number {
    return this.ruler ? Math.hypot(this.ruler.to[0] - this.ruler.from[0], this.ruler.to[1] - this.ruler.from[1]) : NaN;
  }

  /// The place of the world under a pixel of the canvas.
  place(x: number, y: number): Point {
    return [
      this.centre[0] + (x - this.canvas.clientWidth / 2) / this.scale,
      this.centre[1] - (y - this.canvas.clientHeight / 2) / this.scale,
    ];
  }

  /// The pixel of the canvas where a place of the world is.
  pixel(x: number, y: number): Point {
    return this.view().at(x, y);
  }

  private view(): View {
    const x0 = this.canvas.clientWidth / 2 - this.centre[0] * this.scale;
    const y0 = this.canvas.clientHeight / 2 + this.centre[1] * this.scale;
    return { scale: this.scale, at: (x, y) => [x0 + x * this.scale, y0 - y * this.scale] };
  }

  private draw_now(): void {
    const { g, width, height } = fit_canvas(this.canvas);
    const colours = theme();
    g.fillStyle = colours.ground;
    g.fillRect(0, 0, width, height);
    if (this.scale === 0) this.fit_if_new();
    const world = this.world;
    if (!world || this.scale === 0) return;
    const scene: Scene = { g, view: this.view(), theme: colours, layers: this.layers, tick: this.session.tick };
    const { shown } = this;
    const worlds = shown.flatMap((run) => run.world ? [run.world] : []);
    draw_world(scene, world, this.session.tick * (this.session.run?.tick_s ?? 0), worlds);
    this.draw_goals(scene, world, shown);
    if (this.tool) draw_start(scene, world);
    else this.draw_runs(scene, shown);
    if (this.ruler) draw_ruler(scene, this.ruler.from, this.ruler.to);
    draw_scale(scene, height);
    this.cursor.draw(g, colours);
  }

  private draw_runs(scene: Scene, shown: Run[]): void {
    const told = this.inside_layers.shown_tick;
    const has_insides = told !== undefined && shown.includes(told.run);
    if (has_insides) this.inside_layers.draw_areas(scene);
    for (const run of shown) draw_paths(scene, run);
    const chosen = shown.find((run) => run.index === this.session.chosen) ?? shown[0];
    if (chosen && this.layers.has("obstacles")) draw_virtual_obstacles(scene, chosen);
    if (chosen && this.layers.has("scan")) draw_scan(scene, chosen);
    // A laser's rays would cover it.
    if (chosen) draw_steering(scene, chosen);
    for (const run of shown) {
      if (this.layers.has("targets")) draw_virtual_targets(scene, run);
      draw_events(scene, run);
    }
    if (has_insides) this.inside_layers.draw_places(scene);
    this.draw_robots(scene, shown);
  }

  private draw_robots(scene: Scene, shown: Run[]): void {
    const at_place = new Map<string, number>();
    for (const run of shown) {
      const pose = run.truth[run.index_at(scene.tick)];
      const place = `${pose?.x.toFixed(2)} ${pose?.y.toFixed(2)}`;
      const nth = at_place.get(place) ?? 0;
      at_place.set(place, nth + 1);
      draw_robot(scene, run, shown.length > 1 ? nth : undefined);
    }
  }

  private add_controls(): void {
    const bar = by_id("map-controls");
    const measure = button("Measure", "Measure a distance: drag on the map (m)", () => this.measure());
    measure.id = "measure";
    measure.setAttribute("aria-pressed", "false");
    const menu = element("details", { id: "layers" }, element("summary", { title: "What the map shows (l)" }, "Layers"));
    const list = element("div", { class: "menu" });
    for (const [name, label] of kLayers) {
      const box = element("input", { type: "checkbox", "data-layer": name });
      box.checked = this.layers.has(name);
      box.addEventListener("change", () => {
        if (box.checked) this.layers.add(name);
        else this.layers.delete(name);
        if (name === "insides") this.session.wants_insides = box.checked;
        this.session.tell("layers");
      });
      list.append(element("label", {}, box, label));
    }
    menu.append(list);
    bar.append(
      button("+", "Zoom in (+)", () => this.zoom(1.3)), button("−", "Zoom out (-)", () => this.zoom(1 / 1.3)),
      button("Fit", "Show the whole world (0)", () => this.fit()), measure, menu);
  }

  private add_pointer(): void {
    const canvas = this.canvas;
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      if (!this.picker || this.measuring) canvas.setPointerCapture(event.pointerId);
      this.press(event.offsetX, event.offsetY);
    });
    canvas.addEventListener("pointermove", (event) => this.move(event.offsetX, event.offsetY));
    canvas.addEventListener("pointerup", () => this.release());
    canvas.addEventListener("dblclick", (event) => {
      const near = this.nearest_event(event.offsetX, event.offsetY);
      if (near) this.session.go_to(near.tick);
    });
  }

  private press(x: number, y: number): void {
    const place = this.place(x, y);
    if (this.picker && !this.measuring) return this.picker(place);
    this.drag = { x, y };
    if (this.measuring) this.ruler = { from: place, to: place };
    else this.tool?.down(place);
  }

  private move(x: number, y: number): void {
    this.show_status(x, y);
    if (!this.drag) return;
    if (this.measuring && this.ruler) {
      this.ruler.to = this.place(x, y);
      this.draw();
    } else if (this.tool) {
      this.tool.move(this.place(x, y));
      this.draw();
    } else {
      this.pan(this.drag.x - x, this.drag.y - y);
      this.drag = { x, y };
    }
  }

  private release(): void {
    if (this.drag && !this.measuring) this.tool?.up();
    this.drag = undefined;
    this.draw();
  }

  private nearest_event(x: number, y: number): RunEvent | undefined {
    const view = this.view();
    let best: RunEvent | undefined;
    let least = 12;
    for (const run of this.session.shown) {
      for (const event of run.events) {
        if (event.tick > this.session.tick) continue;
        const [ex, ey] = view.at(...event.place);
        const distance = Math.hypot(ex - x, ey - y);
        if (distance >= least) continue;
        least = distance;
        best = event;
      }
    }
    return best;
  }

  private show_status(x: number, y: number): void {
    if (this.scale === 0) return;
    const [wx, wy] = this.place(x, y);
    const near = this.nearest_event(x, y);
    const what = near ? `   ${kKindNames[near.kind]}${near.shadow ? " (in shadow)" : ""} at tick ${near.tick}` +
      `${near.rule ? `, ${near.rule}` : ""}${near.text ? `: ${near.text}` : ""}` : "";
    this.status.textContent = `x ${wx.toFixed(2)} m   y ${wy.toFixed(2)} m${what}`;
  }
}
