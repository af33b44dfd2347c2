// SPDX-License-Identifier: Apache-2.0
// What if: another behaviour or value from the chosen tick on, and runs of other graphs and worlds.
// The server carries out what it tells as a command line, so that a terminal gives the same.

import { ChangesForm } from "./changes_form";
import { Drawing } from "./drawing";
import { button, by_id, element } from "./elements";
import type { MapView } from "./map_view";
import type { Run } from "./run";
import { ask_for } from "./server";
import type { Choices, RuleEdit, Started } from "./server";
import type { Session } from "./session";
import { names_of } from "./graph_names";

type Open = (started: Started) => Promise<Run>;

/// Why a run cannot be branched from a tick on; empty if it can.
function why_no_branch({ served, last_tick, outcome, recording }: Run, tick: number): string {
  if (served === undefined) return "this run cannot be branched";
  const changed = recording.changes.find((change) => change.tick <= tick && change.changes.length > 0);
  if (changed) return `the run was changed at tick ${changed.tick}: choose a tick before it`;
  if (tick > last_tick) return `the run ended at tick ${last_tick}: choose an earlier tick`;
  if (tick < last_tick || outcome === "running" || outcome === "timeout") return "";
  return `the run ends at this tick (${outcome}), and nothing goes on from there: choose an earlier tick`;
}

export class WhatIf {
  private readonly max_ticks = element("input", { type: "number", min: "1", max: "100000", value: "2000", "aria-label": "Most ticks" });
  private readonly at = element("b");
  private readonly told = element("ol", { id: "branches" });
  private readonly message = element("p", { class: "warn", role: "alert" });
  private readonly graph = element("select", { "aria-label": "Graph", id: "run-graph" });
  private readonly world = element("select", { "aria-label": "World", id: "run-world" });
  private readonly drawing: Drawing;
  /// What there is to go on from, and what there is not without a run.
  private readonly branching = element("div");
  private readonly running = element("h2");
  private readonly hint = element("p", { id: "first-steps" },
    "Choose a graph and a world, or draw one: drag walls on the map, or move a cross there by the arrow keys. Then press Run, and see where the robot goes.");
  private readonly form: ChangesForm;
  private is_drawing: boolean;
  private readonly go = button("Branch", "Go on from this tick with these changes (b)", () => void this.branch());
  /// Why there is no branch from the chosen tick.
  private readonly why_not = element("p", { class: "faint", id: "no-branch", role: "status" });

  constructor(private readonly session: Session, private readonly map: MapView, private readonly panel: HTMLElement,
    choices: Choices, private readonly open: Open) {
    this.drawing = new Drawing(map, () => this.let_draw());
    this.form = new ChangesForm(choices, (stage, part) => this.current(stage, part));
    this.go.id = "branch";
    this.go.className = "strong";
    const run = button("Run", "Run this graph in this world", () => void this.run());
    run.id = "run";
    run.className = "strong";
    for (const name of choices.graphs) this.graph.append(element("option", { value: name }, name));
    this.graph.value = choices.graphs.includes("default") ? "default" : choices.graphs[0] ?? "";
    this.world.append(element("option", { value: "" }, "draw one"));
    for (const name of choices.worlds) this.world.append(element("option", { value: name }, name));
    this.world.value = choices.worlds.includes("u-trap") ? "u-trap" : "";
    this.world.addEventListener("change", () => this.let_draw());
    this.branching.append(
      element("h2", {}, "What if"), element("p", {}, "From tick ", this.at, " on:"), this.form.box,
      element("div", { class: "row" }, element("label", {}, "at most ", this.max_ticks, " ticks"), this.go), this.why_not);
    this.is_drawing = session.runs.length === 0;
    if (this.is_drawing) this.world.value = "";
    panel.append(
      this.branching, this.message, this.told, this.running, this.hint,
      element("div", { class: "row" }, this.graph, " in ", this.world, run), this.drawing.box);
    this.show_drawing();
    session.listen((change) => this.refresh(change === "runs"));
    this.refresh(true);
  }

  private let_draw(): void {
    this.is_drawing = true;
    this.show_drawing();
  }

  /// Whether the map shows the world that is drawn: while somebody draws, and not once it was run.
  show_drawing(): void {
    const draws = this.is_drawing && this.world.value === "" && !this.panel.hidden;
    this.drawing.box.hidden = this.world.value !== "";
    this.map.use(draws ? this.drawing : undefined);
  }

  async branch(): Promise<void> {
    const run = this.session.run;
    if (!run || run.served === undefined || this.why_no_branch() !== "") return;
    await this.say_errors(() => this.ask("branch", {
      recording: run.served, tick: this.session.tick, max_ticks: Number(this.max_ticks.value), ...this.form.changes,
    }));
  }

  /// Why the chosen run has no branch from the chosen tick; empty if it can have one.
  why_no_branch(): string {
    const { run, tick } = this.session;
    return run ? why_no_branch(run, tick) : "there is no run to branch";
  }

  /// Goes on from the chosen tick with other rule bases, and all else as it was. Throws what is wrong.
  async branch_with(rules: RuleEdit[]): Promise<Started> {
    const run = this.session.run;
    const why_not = this.why_no_branch();
    if (!run || why_not !== "") throw new Error(why_not);
    return this.ask("branch", { recording: run.served, tick: this.session.tick, max_ticks: Number(this.max_ticks.value), rules });
  }

  private async run(): Promise<void> {
    const drawn = this.world.value === "";
    const world = drawn ? this.drawing.drawn : this.world.value;
    const request = { graph: this.graph.value, world, max_ticks: Number(this.max_ticks.value) };
    if (!await this.say_errors(() => this.ask("run", request))) return;
    this.map.fit();
    // A space then pauses, and runs nothing again.
    by_id("play").focus();
  }

  private async ask(what: "branch" | "run", request: object): Promise<Started> {
    const started = await ask_for(what, request);
    const { report } = started;
    this.is_drawing = false;
    this.show_drawing();
    const run = await this.open(started);
    this.told.prepend(element("li", {}, element("b", {}, started.name), ` ${report.outcome} after ${report.ticks} ticks`,
      element("code", { title: "The same on the command line" }, started.command)));
    if (what === "run") {
      this.session.chosen = run.index;
      for (const other of this.session.runs) if (other !== run) this.session.hidden.add(other.index);
      this.session.tell("runs");
      this.session.go_to(0);
      this.session.set_playing(true);
    }
    return started;
  }

  /// Whether it went well.
  private async say_errors(work: () => Promise<unknown>): Promise<boolean> {
    this.message.textContent = "";
    try {
      await work();
      return true;
    } catch (error) {
      this.message.textContent = error instanceof Error ? error.message : String(error);
      return false;
    }
  }

  private current(stage: string, part: string): string | undefined {
    const chosen = this.session.run?.graph[stage] as Record<string, unknown> | undefined;
    if (!chosen) return undefined;
    return names_of(chosen[part]);
  }

  private refresh(others: boolean): void {
    this.at.textContent = String(this.session.tick);
    const first = this.session.runs.length === 0;
    this.branching.hidden = first;
    this.hint.hidden = !first;
    this.running.textContent = first ? "A first run" : "Another run";
    const why_not = this.why_no_branch();
    this.go.disabled = why_not !== "";
    if (this.why_not.textContent !== why_not) this.why_not.textContent = why_not;
    if (others) this.form.refresh();
  }
}
