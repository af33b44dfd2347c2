// SPDX-License-Identifier: Apache-2.0
// What a person does to a run under way: pause, a tick, resume, pace, stop, another target, another
// behaviour. The server does what `clew pause`, `swap`, ... do, so the run's recording holds all of it.

import { ChangesForm } from "./changes_form";
import { button, by_id, element } from "./elements";
import { names_of } from "./graph_names";
import type { MapView } from "./map_view";
import { ask_control } from "./server";
import type { Choices, Order, RuleEdit } from "./server";
import type { Session } from "./session";
import type { Point } from "./world";

/// Simulated seconds a second; 0 is as fast as it can.
const kPaces: [number, string][] = [[0, "as fast as it can"], ...[0.5, 1, 2, 5, 10, 30, 100].map((pace): [number, string] => [pace, `${pace}×`])];
const kCentimetres = 2;

export class Control {
  private readonly pause = button("Pause", "Hold the run before its next tick (k)", () => void this.toggle());
  private readonly step = button("One tick", "Run a single tick of a run that is paused (j)", () => void this.do_step());
  private readonly stop = button("Stop", "End the run", () => void this.ask({ order: "stop" }));
  private readonly pace = element("select", { id: "pace", "aria-label": "Pace" });
  private readonly goal = button("New target", "Then click on the map: the robot goes there (g)", () => this.choose_goal());
  private readonly swap = button("Change", "From the next tick on that nobody has begun", () => void this.do_swap());
  private readonly message = element("p", { class: "warn", role: "alert" });
  private readonly told = element("ol", { id: "orders" });
  private readonly form: ChangesForm;
  /// What was put in a part's place since the run began.
  private readonly changed = new Map<string, string>();
  private paused = false;
  private over = false;

  constructor(private readonly session: Session, private readonly map: MapView, panel: HTMLElement, choices: Choices) {
    this.form = new ChangesForm(choices, (stage, part) => this.current(stage, part));
    this.pause.id = "live-pause";
    this.step.id = "live-step";
    this.stop.id = "live-stop";
    this.goal.id = "live-goal";
    this.swap.id = "live-swap";
    this.swap.className = "strong";
    this.goal.setAttribute("aria-pressed", "false");
    this.pace.append(element("option", { value: "" }, "as it was started"), ...kPaces.map(([pace, text]) => element("option", { value: String(pace) }, text)));
    this.pace.addEventListener("change", () => {
      if (this.pace.value !== "") void this.ask({ order: "pace", factor: Number(this.pace.value) });
    });
    panel.append(
      element("h2", {}, "The run"),
      element("div", { class: "row" }, this.pause, this.step, this.stop, element("label", {}, "pace ", this.pace)),
      element("div", { class: "row" }, this.goal), this.message, this.told,
      element("h2", {}, "Another behaviour"), this.form.box, element("div", { class: "row" }, this.swap));
    session.listen((change) => {
      if (change === "runs" || (change === "data" && this.form.empty)) this.form.refresh();
    });
    this.show();
  }

  /// The run has ended: there is nothing left to control.
  end(): void {
    this.over = true;
    this.map.pick(undefined);
    this.show();
  }

  async toggle(): Promise<void> {
    if (this.over) return;
    const tick = await this.ask({ order: this.paused ? "resume" : "pause" });
    // A run that somebody else has let go on refuses to be resumed.
    if (tick !== undefined || this.paused) this.paused = !this.paused;
    this.show();
  }

  async do_step(): Promise<void> {
    if (this.over) return;
    await this.ask({ order: "step", ticks: 1 });
  }

  choose_goal(): void {
    if (this.over) return;
    const takes = this.goal.getAttribute("aria-pressed") !== "true";
    this.goal.setAttribute("aria-pressed", String(takes));
    this.map.pick(takes ? (place) => void this.send_to(place) : undefined);
  }

  private async send_to(place: Point): Promise<void> {
    this.goal.setAttribute("aria-pressed", "false");
    this.map.pick(undefined);
    const [x, y] = [Number(place[0].toFixed(kCentimetres)), Number(place[1].toFixed(kCentimetres))];
    await this.ask({ order: "goal", x, y });
  }

  /// The run goes on with these rule bases. Throws what the run says against it.
  async use_rules(rules: RuleEdit[]): Promise<{ said: string; command: string }> {
    if (this.over) throw new Error("the run has ended; branch its recording");
    const { tick, command } = await ask_control({ order: "swap", with: {}, set: [], rules });
    this.note("rules", tick, command);
    return { said: `used from tick ${tick} on`, command };
  }

  private async do_swap(): Promise<void> {
    const { changes } = this.form;
    if (await this.ask({ order: "swap", ...changes }) === undefined) return;
    for (const [place, names] of Object.entries(changes.with)) this.changed.set(place, names.join(", "));
    this.form.clear();
  }

  /// The tick from which on it holds; nothing if the run refused.
  private async ask(order: Order): Promise<number | undefined> {
    this.message.textContent = "";
    try {
      const { tick, command } = await ask_control(order);
      this.note(order.order, tick, command);
      by_id("notice").textContent = order.order === "pause" ? `paused at tick ${tick}` : "";
      return tick;
    } catch (error) {
      this.message.textContent = error instanceof Error ? error.message : String(error);
      return undefined;
    }
  }

  private note(what: string, tick: number, command: string): void {
    this.told.prepend(element("li", {}, `${what} at tick ${tick}`, element("code", { title: "The same on the command line" }, command)));
  }

  private current(stage: string, part: string): string | undefined {
    const now = this.changed.get(`${stage}.${part}`);
    if (now !== undefined) return now;
    const chosen = this.session.run?.graph[stage] as Record<string, unknown> | undefined;
    return chosen ? names_of(chosen[part]) : undefined;
  }

  private show(): void {
    this.pause.textContent = this.paused ? "Resume" : "Pause";
    for (const each of [this.pause, this.stop, this.goal, this.swap]) each.disabled = this.over;
    this.pace.disabled = this.over;
    this.step.disabled = this.over || !this.paused;
  }
}
