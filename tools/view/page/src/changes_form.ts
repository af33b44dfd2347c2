// SPDX-License-Identifier: Apache-2.0
// A form made from the registry: another behaviour in a part's place, other values of parameters,
// with their units, ranges and meanings.

import { button, element } from "./elements";
import type { Behaviour, Changes, Choices, Parameter, Part, SetEntry, Stage } from "./server";

export class ChangesForm {
  readonly box = element("div", { class: "changes" });
  private readonly stage = element("select", { "aria-label": "Stage", "data-field": "stage" });
  private readonly part = element("select", { "aria-label": "Part", "data-field": "part" });
  private readonly behaviour = element("select", { "aria-label": "Behaviour", "data-field": "behaviour" });
  private readonly summary = element("p", { class: "faint" });
  private readonly parameters = element("div", { class: "parameters" });
  private readonly list = element("ul", { class: "chosen", "aria-label": "Changes" });
  private readonly withs = new Map<string, string[]>();
  private readonly sets = new Map<string, SetEntry>();

  /// `current` tells the behaviour that a part has now; nothing if the graph lacks the stage.
  constructor(private readonly choices: Choices, private readonly current: (stage: string, part: string) => string | undefined) {
    this.box.append(
      element("div", { class: "row" }, this.stage, this.part, this.behaviour), this.summary, this.parameters, this.list);
    this.stage.addEventListener("change", () => this.show_stage());
    this.part.addEventListener("change", () => this.show_part());
    this.behaviour.addEventListener("change", () => this.choose_behaviour());
    this.refresh();
  }

  /// What was chosen, as the server takes it.
  get changes(): Changes {
    return { with: Object.fromEntries(this.withs), set: [...this.sets.values()] };
  }

  /// Whether there is nothing to choose from, as long as nobody has told of the run's graph.
  get empty(): boolean {
    return this.stage.options.length === 0;
  }

  /// What was chosen has been done.
  clear(): void {
    this.withs.clear();
    this.sets.clear();
    this.show_part();
  }

  /// Another run may have other stages.
  refresh(): void {
    const stages = this.choices.stages.filter((stage) => stage.parts.some((part) => this.current(stage.name, part.name) !== undefined));
    const before = this.stage.value;
    fill(this.stage, stages.map((stage) => stage.name));
    if (stages.some((stage) => stage.name === before)) this.stage.value = before;
    else if (stages.some((stage) => stage.name === "recover")) this.stage.value = "recover";
    this.show_stage();
  }

  private get chosen_stage(): Stage | undefined {
    return this.choices.stages.find((stage) => stage.name === this.stage.value);
  }
  private get chosen_part(): Part | undefined {
    return this.chosen_stage?.parts.find((part) => part.name === this.part.value);
  }
  private get chosen_behaviour(): Behaviour | undefined {
    return this.chosen_part?.variants.find((variant) => variant.name === this.behaviour.value);
  }
  private get place(): string {
    return `${this.stage.value}.${this.part.value}`;
  }

  private show_stage(): void {
    fill(this.part, this.chosen_stage?.parts.map((part) => part.name) ?? []);
    this.show_part();
  }

  private show_part(): void {
    fill(this.behaviour, this.chosen_part?.variants.map((variant) => variant.name) ?? []);
    const now = this.withs.get(this.place)?.[0] ?? this.current(this.stage.value, this.part.value)?.split(", ")[0];
    if (now !== undefined && this.chosen_part?.variants.some((variant) => variant.name === now)) this.behaviour.value = now;
    this.show_behaviour();
  }

  private choose_behaviour(): void {
    const now = this.current(this.stage.value, this.part.value);
    if (now === this.behaviour.value) this.withs.delete(this.place);
    else this.withs.set(this.place, [this.behaviour.value]);
    // Values of the behaviour that was there mean nothing to this one.
    for (const [key, entry] of this.sets) {
      if (entry.stage === this.stage.value && entry.part === this.part.value && entry.behaviour !== this.behaviour.value) this.sets.delete(key);
    }
    this.show_behaviour();
  }

  private show_behaviour(): void {
    const behaviour = this.chosen_behaviour;
    this.summary.textContent = behaviour?.summary ?? "";
    const own = behaviour?.parameters.map((parameter) => this.parameter_row(parameter, this.part.value, behaviour.name)) ?? [];
    const shared = this.chosen_stage?.parameters.map((parameter) => this.parameter_row(parameter, "", "")) ?? [];
    this.parameters.replaceChildren(...own, ...shared);
    this.show_list();
  }

  private parameter_row(parameter: Parameter, part: string, behaviour: string): HTMLElement {
    const key = [this.stage.value, part, behaviour, parameter.name].join(".");
    const input = this.input(parameter);
    const before = this.sets.get(key);
    if (before) set_value(input, before.value);
    input.addEventListener("change", () => {
      const value = value_of(input, parameter);
      if (value === undefined) this.sets.delete(key);
      else this.sets.set(key, { stage: this.stage.value, part, behaviour, name: parameter.name, value });
      this.show_list();
    });
    const unit = parameter.unit === "1" ? "" : parameter.unit;
    const range = parameter.range ? `${parameter.range[0]} to ${parameter.range[1]}` : "";
    return element("label", { title: `${parameter.doc}${range ? `; ${range} ${unit}` : ""}` },
      element("span", {}, parameter.name), input, element("small", {}, unit), element("em", {}, parameter.doc));
  }

  private input(parameter: Parameter): HTMLInputElement | HTMLSelectElement {
    const attributes = { "data-parameter": parameter.name, "aria-label": parameter.name };
    if (parameter.choices && typeof parameter.default === "string") {
      const select = element("select", attributes);
      fill(select, ["", ...parameter.choices]);
      return select;
    }
    if (typeof parameter.default === "boolean") {
      const select = element("select", attributes);
      fill(select, ["", "true", "false"]);
      return select;
    }
    const input = element("input", { ...attributes, placeholder: String(parameter.default) });
    if (parameter.range) {
      input.type = "number";
      input.min = String(parameter.range[0]);
      input.max = String(parameter.range[1]);
      input.step = Number.isInteger(parameter.default) && parameter.unit !== "m" ? "1" : "any";
    }
    return input;
  }

  private show_list(): void {
    const rows: [string, () => void][] = [];
    for (const [place, names] of this.withs) rows.push([`${place} = ${names.join(", ")}`, () => this.withs.delete(place)]);
    for (const [key, entry] of this.sets) {
      rows.push([`${entry.stage}.${entry.name} = ${String(entry.value)}`, () => this.sets.delete(key)]);
    }
    this.list.replaceChildren(...rows.map(([text, remove]) => element("li", {}, text, button("×", "Take this change back", () => {
      remove();
      this.show_part();
    }))));
  }
}

function fill(select: HTMLSelectElement, names: string[]): void {
  select.replaceChildren(...names.map((name) => element("option", { value: name }, name === "" ? "as it is" : name)));
}

function set_value(input: HTMLInputElement | HTMLSelectElement, value: boolean | number | string): void {
  input.value = String(value);
}

/// Nothing where the field is empty: then the value stays.
function value_of(input: HTMLInputElement | HTMLSelectElement, parameter: Parameter): boolean | number | string | undefined {
  if (input.value === "") return undefined;
  if (typeof parameter.default === "boolean") return input.value === "true";
  return parameter.range ? Number(input.value) : input.value;
}
