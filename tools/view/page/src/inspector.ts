// SPDX-License-Identifier: Apache-2.0
// The messages of the chosen tick: every field of every topic, of the chosen run, or of two runs
// side by side. A click on a number plots it.

import { field_text, unit_of } from "./cdr_fields";
import type { Field } from "./cdr_fields";
import { element, once_a_frame } from "./elements";
import type { Plots } from "./plots";
import type { Run } from "./run";
import type { Session } from "./session";

const kMostRows = 400;

export class Inspector {
  private readonly filter = element("input", {
    type: "search", placeholder: "Find a field", "aria-label": "Find a field", id: "field-filter",
  });
  private readonly list = element("div", { id: "messages" });
  private readonly open = new Set<string>(["state", "guidance", "command"]);
  private readonly draw = once_a_frame(() => this.draw_now());

  constructor(private readonly session: Session, private readonly plots: Plots, private readonly panel: HTMLElement) {
    panel.append(this.filter, this.list);
    this.filter.addEventListener("input", () => this.draw());
    session.listen(() => this.draw());
  }

  private fields(run: Run | undefined, name: string): Field[] {
    const topic = run?.recording.topic(name);
    const index = topic?.index_at(this.session.tick) ?? -1;
    if (!topic || index < 0) return [];
    try {
      return topic.schema.fields(topic.sample(index));
    } catch (error) {
      return [{ path: "(not a message)", value: String(error) }];
    }
  }

  private draw_now(): void {
    if (this.panel.hidden) return;
    const run = this.session.run;
    if (!run) return;
    const other = this.session.shown.find((each) => each !== run);
    const names = [...new Set([...run.recording.topics.keys(), ...(other?.recording.topics.keys() ?? [])])].sort();
    this.list.replaceChildren(...names.map((name) => this.draw_topic(name, run, other)));
  }

  private draw_topic(name: string, run: Run, other: Run | undefined): HTMLElement {
    const wanted = this.filter.value.trim().toLowerCase();
    const box = element("details", { "data-topic": name });
    box.open = wanted !== "" || this.open.has(name);
    const summary = element("summary", {}, name);
    box.append(summary);
    box.addEventListener("toggle", () => {
      if (this.filter.value.trim() !== "") return;
      if (box.open === this.open.has(name)) return;
      if (box.open) this.open.add(name);
      else this.open.delete(name);
      this.draw();
    });
    if (!box.open) return box;
    const ours = this.fields(run, name);
    const theirs = new Map(this.fields(other, name).map((field) => [field.path, field]));
    const paths = [...ours.map((field) => field.path), ...[...theirs.keys()].filter((path) => !ours.some((f) => f.path === path))];
    const by_path = new Map(ours.map((field) => [field.path, field]));
    const table = element("table");
    if (other) {
      table.append(element("tr", {}, element("th", {}, "field"), head_of(run), head_of(other)));
    }
    const rows = paths.filter((path) => `${name}.${path}`.toLowerCase().includes(wanted));
    for (const path of rows.slice(0, kMostRows)) table.append(this.row(name, path, by_path.get(path), other ? theirs.get(path) : null));
    if (rows.length > kMostRows) table.append(element("tr", {}, element("td", {}, `and ${rows.length - kMostRows} more: find them by name`)));
    if (paths.length === 0) table.append(element("tr", {}, element("td", { class: "faint" }, "no sample at this tick")));
    box.append(table);
    return box;
  }

  /// `other` is null where only one run is looked at.
  private row(topic: string, path: string, ours: Field | undefined, other: Field | undefined | null): HTMLElement {
    const unit = unit_of(path);
    const name = element("td", { "data-path": path }, path);
    const field = ours ?? other ?? undefined;
    if (field && typeof field.value !== "string" && !path.startsWith("(")) {
      const plot = element("button", { type: "button", class: "plot", title: `Plot ${topic}.${path} over time`, "aria-label": `Plot ${topic}.${path}` }, "∿");
      plot.addEventListener("click", () => this.plots.add(topic, path));
      name.append(plot);
    }
    const cells = [element("td", { class: "value" }, readable(ours) + (unit && ours ? ` ${unit}` : ""))];
    cells[0]?.setAttribute("title", field_text(ours));
    if (other !== null) {
      cells.push(element("td", { class: "value", title: field_text(other) }, readable(other) + (unit && other ? ` ${unit}` : "")));
    }
    const row = element("tr", {}, name, ...cells);
    if (other !== null && field_text(ours) !== field_text(other)) row.classList.add("differs");
    return row;
  }
}

/// The number that the run has on the page, and its name as far as there is room.
function head_of(run: Run): HTMLElement {
  const { name } = run.recording;
  return element("th", { class: "run-name", title: name }, element("b", {}, String(run.index + 1)), ` ${name.replace(/\.mcap$/, "")}`);
}

/// Short; the whole number is in the title.
function readable(field: Field | undefined): string {
  if (!field) return "–";
  if (field.word === undefined && typeof field.value === "number" && !Number.isInteger(field.value)) {
    const size = Math.abs(field.value);
    return size !== 0 && (size < 1e-4 || size >= 1e7) ? field.value.toExponential(4) : field.value.toFixed(4);
  }
  return field_text(field);
}
