// SPDX-License-Identifier: Apache-2.0
// What each component of the chosen run saw, weighed and decided at the chosen tick, as the server
// explains it, with the values behind the words. Grids and lists are drawn.

import { element, once_a_frame } from "./elements";
import { is_grid } from "./inside_values";
import type { Group, Value } from "./inside_values";
import { draw_grid, draw_list } from "./inside_drawings";
import type { MapView } from "./map_view";
import type { Run } from "./run";
import { RuleEditor, rule_files } from "./rule_editor";
import type { RuleUse } from "./rule_editor";
import { ask_insides } from "./server";
import type { Choices, Told } from "./server";
import type { Session } from "./session";

/// Asking costs the server a replay: only for a tick that somebody stays at.
const kPatience_ms = 250;
/// As many are read faster than seen.
const kFewNumbers = 4;
const kUnits: Record<string, string> = {
  m: "m", rad: "rad", s: "s", mps: "m/s", radps: "rad/s", mps2: "m/s²", radps2: "rad/s²", ticks: "ticks",
};

export class Insides {
  private readonly body = element("div", { id: "insides", "aria-live": "polite" });
  private readonly open = new Set<string>();
  private timer: number | undefined;
  private asked = "";
  private told: Told | undefined;
  private told_of: { run: Run | undefined; tick: number } | undefined;
  /// What rules can be edited with, once the server has told.
  private edits: { choices: Choices; use: RuleUse } | undefined;
  private readonly editors = new Map<Run, Map<string, RuleEditor[]>>();
  private readonly draw = once_a_frame(() => this.draw_now());

  constructor(private readonly session: Session, private readonly map: MapView, private readonly panel: HTMLElement, private readonly has_server: boolean) {
    panel.append(this.body);
    session.listen((change) => {
      if (change !== "data") this.look();
      if (change === "layers" || change === "theme") this.show_on_map();
    });
    this.look();
  }

  /// From now on rules can be edited, and are used so.
  let_edit(choices: Choices, use: RuleUse): void {
    this.edits = { choices, use };
    this.draw();
  }

  /// What is written in them stays from tick to tick.
  private editors_of(stage: string): RuleEditor[] {
    const run = this.told_of?.run;
    if (!run || !this.edits) return [];
    const { choices, use } = this.edits;
    const of_run = this.editors.get(run) ?? new Map<string, RuleEditor[]>();
    this.editors.set(run, of_run);
    const editors = of_run.get(stage) ?? rule_files(run, choices, stage).map((file) => new RuleEditor(file, use));
    of_run.set(stage, editors);
    for (const editor of editors) editor.refresh();
    return editors;
  }

  /// Which tick of which run is looked at; nothing where that cannot be told.
  private get wanted(): { recording: number; tick: number } | undefined {
    const served = this.session.run?.served;
    return served === undefined ? undefined : { recording: served, tick: this.session.tick };
  }

  private look(): void {
    if (this.panel.hidden && !this.session.wants_insides) return;
    const wanted = this.wanted;
    if (!this.has_server) return this.say("Insides are computed when somebody asks, by the server of clew view. This page has no server; clew explain tells them of the recording.");
    if (!wanted) return;
    if (this.session.playing) return this.say("Pause to see the insides of a tick.");
    const key = `${wanted.recording} ${wanted.tick}`;
    // Whoever waits asks of another tick or run.
    window.clearTimeout(this.timer);
    if (key === this.asked) return;
    if (!this.told) this.say("Stay at a tick to see its insides: of a run under way, pause it or choose a tick.");
    const run = this.session.run;
    this.timer = window.setTimeout(() => void this.ask(key, run, wanted), kPatience_ms);
  }

  private async ask(key: string, run: Run | undefined, wanted: { recording: number; tick: number }): Promise<void> {
    this.asked = key;
    this.body.setAttribute("aria-busy", "true");
    try {
      const told = await ask_insides(wanted);
      if (this.asked !== key) return;
      this.told = told;
      this.told_of = { run, tick: wanted.tick };
      this.draw();
      this.show_on_map();
    } catch (error) {
      if (this.asked !== key) return;
      this.say(error instanceof Error ? error.message : String(error));
    }
    this.body.removeAttribute("aria-busy");
  }

  private show_on_map(): void {
    const { told, told_of } = this;
    this.map.show_insides(told && told_of?.run ? { run: told_of.run, tick: told_of.tick, told } : undefined);
  }

  private say(text: string): void {
    this.asked = "";
    window.clearTimeout(this.timer);
    if (this.body.children.length === 1 && this.body.textContent === text) return;
    this.body.replaceChildren(element("p", { class: "faint" }, text));
  }

  private draw_now(): void {
    if (!this.told || this.asked === "") return;
    const { stages, command } = this.told;
    this.body.replaceChildren(...stages.map(({ stage, behaviour, text, inside }) => {
      const section = element("section", { "data-stage": stage });
      section.append(element("h2", {}, `${stage} · ${behaviour}`), element("p", { class: "told" }, text));
      if (Object.keys(inside).length > 0) section.append(this.folded(stage, "values", inside, this.open.has(stage)));
      section.append(...this.editors_of(stage).map(({ box }) => box));
      return section;
    }), element("p", { class: "faint" }, "The same on the command line: ", element("code", {}, command)));
    this.body.dataset["tick"] = String(stages[0]?.tick ?? "");
  }

  /// A group under a line that opens it; it is drawn when it is open, and stays open from tick to tick.
  private folded(key: string, name: string, group: Group, open: boolean): HTMLElement {
    const box = element("details", { "data-inside": key }, element("summary", {}, name));
    const fill = (): void => {
      if (box.children.length === 1) box.append(this.draw_group(key, group));
    };
    box.addEventListener("toggle", () => {
      if (box.open) {
        this.open.add(key);
        fill();
      } else {
        this.open.delete(key);
      }
    });
    box.open = open;
    if (open) fill();
    return box;
  }

  private draw_group(key: string, group: Group): HTMLElement {
    const list = element("dl", { class: "values" });
    const rest: HTMLElement[] = [];
    for (const [name, value] of Object.entries(group)) {
      const drawn = this.draw_value(`${key}.${name}`, name, value);
      if (typeof drawn === "string") list.append(element("dt", {}, label_of(name)), element("dd", {}, drawn + unit_text(name, value)));
      else rest.push(drawn);
    }
    return element("div", { class: "group" }, list, ...rest);
  }

  /// A text for what is said in a line, else what is drawn.
  private draw_value(key: string, name: string, value: Value): string | HTMLElement {
    if (value === null) return "unknown";
    if (typeof value === "boolean") return value ? "yes" : "no";
    if (typeof value === "number") return short(value);
    if (typeof value === "string") return value;
    if (is_grid(value)) return draw_grid(label_of(name), unit_of(name), value);
    if (!Array.isArray(value)) return this.folded(key, label_of(name), value, this.open.has(key) || is_first(key));
    if (value.length === 0) return "none";
    if (value.every((each) => typeof each === "number")) {
      if (value.length <= kFewNumbers) return value.map((each) => short(each as number)).join(", ");
      return draw_list(label_of(name), unit_of(name), value as number[]);
    }
    return this.draw_items(key, label_of(name), value as Group[]);
  }

  /// Like things as a table, if all their values are said in a line.
  private draw_items(key: string, name: string, items: Group[]): HTMLElement {
    const columns = [...new Set(items.flatMap((item) => Object.keys(item)))];
    const plain = items.every((item) => Object.values(item).every((value) => value === null || typeof value !== "object"));
    if (!plain) {
      return element("div", {}, ...items.map((item, index) =>
        this.folded(`${key}.${index}`, `${name}: ${title_of(item, index)}`, item, this.open.has(`${key}.${index}`))));
    }
    const head = element("tr", {}, ...columns.map((column) => element("th", {}, label_of(column) + (unit_of(column) ? `, ${unit_of(column)}` : ""))));
    const rows = items.map((item) => element("tr", {}, ...columns.map((column) => {
      const drawn = item[column] === undefined ? "–" : this.draw_value(key, column, item[column] ?? null);
      return element("td", {}, drawn);
    })));
    return element("figure", { class: "items" }, element("figcaption", {}, name), element("table", {}, head, ...rows));
  }
}

/// A group right below its stage is that of the behaviour itself, and shown at once.
function is_first(key: string): boolean {
  return key.split(".").length === 2;
}

function title_of(item: Group, index: number): string {
  const first = Object.values(item)[0];
  if (typeof first === "number") return short(first);
  return typeof first === "string" ? first : String(index + 1);
}

function unit_of(name: string): string {
  return kUnits[name.slice(name.lastIndexOf("_") + 1)] ?? "";
}

function unit_text(name: string, value: Value): string {
  const has_unit = typeof value === "number" || (Array.isArray(value) && value.length > 0);
  const unit = has_unit ? unit_of(name) : "";
  return unit === "" ? "" : ` ${unit}`;
}

function label_of(name: string): string {
  const bare = unit_of(name) === "" ? name : name.slice(0, name.lastIndexOf("_"));
  return bare.replaceAll("_", " ");
}

function short(value: number): string {
  return Number.isInteger(value) ? String(value) : value.toFixed(3);
}
