// SPDX-License-Identifier: Apache-2.0
// The runs of a bench: all, or those that a cell is about. A run whose recording was kept leads to
// its report.

import { button, element } from "../elements";
import type { CellRuns, Runs, Value } from "./bench_data";
import { column_heads, compare_texts } from "./sortable";

/// So many rows at once.
const kRows = 200;
/// Columns that are written otherwise: run, variant, world.
const kNamed = 3;

export class RunsTable {
  readonly box = element("section", { id: "runs", "aria-label": "Runs" });
  private readonly title = element("h2", { tabindex: "-1" }, "Runs");
  private readonly note = element("p", { class: "faint", role: "status" });
  private readonly body = element("tbody");
  private readonly more = button("More", "Show more runs", () => this.show_more());
  private readonly all = button("All runs", "Show all runs of the bench", () => this.show({}, ""));
  private readonly column: Record<string, number>;
  /// Places in `runs.runs`, in the order that is shown.
  private chosen: number[] = [];
  private shown = 0;

  constructor(private readonly runs: Runs) {
    this.column = Object.fromEntries(runs.columns.map((name, i) => [name, i]));
    const columns = ["run", "graph", "world", "family", ...runs.columns.slice(kNamed, -1)];
    const heads = column_heads(columns.map((name) => name.replaceAll("_", " ")), (column, ascending) => this.sort(column, ascending));
    this.box.append(element("div", { class: "head" }, this.title, this.all), this.note,
      element("div", { class: "scroll" }, element("table", {}, element("thead", {}, heads), this.body)), this.more);
    this.show({}, "");
  }

  /// Shows the runs that a cell is about; `of` says which.
  show(wanted: CellRuns, of: string): void {
    this.chosen = this.runs.runs.map((_, i) => i).filter((i) => this.is_of(i, wanted));
    this.title.textContent = of === "" ? "Runs" : `Runs: ${of}`;
    const kept = this.chosen.filter((i) => this.kept(i)).length;
    const listed = this.runs.runs.length;
    this.note.textContent = `${this.chosen.length} of ${listed} runs; ${kept} with a recording`
      + (listed < this.runs.count ? `. Of ${this.runs.count} runs these are listed, failed ones first; all are in results.csv` : "");
    this.all.hidden = of === "";
    for (const head of this.box.querySelectorAll("th")) head.setAttribute("aria-sort", "none");
    // Those that can be looked at come first.
    this.chosen.sort((a, b) => Number(this.kept(b) !== undefined) - Number(this.kept(a) !== undefined) || a - b);
    this.begin();
  }

  /// Shows them, and goes there.
  go_to(wanted: CellRuns, of: string): void {
    this.show(wanted, of);
    this.title.focus();
    this.box.scrollIntoView({ block: "start" });
  }

  private value(index: number, name: string): Value {
    return this.runs.runs[index]?.[this.column[name] ?? -1] ?? null;
  }

  private kept(index: number): { recording: string; report: string } | undefined {
    return this.runs.kept[String(Number(this.value(index, "run")) - 1)];
  }

  private is_of(index: number, wanted: CellRuns): boolean {
    if (wanted.variant !== undefined && this.value(index, "variant") !== wanted.variant) return false;
    if (wanted.family !== undefined && this.world(index).family !== wanted.family) return false;
    if (wanted.solvable !== undefined && this.value(index, "solvable") !== wanted.solvable) return false;
    return wanted.with === undefined || Number(this.value(index, wanted.with)) > 0;
  }

  private world(index: number): { name: string; family: string } {
    return this.runs.worlds[Number(this.value(index, "world"))] ?? { name: "?", family: "?" };
  }

  /// What a row says, column by column.
  private texts(index: number): string[] {
    const { name, family } = this.world(index);
    const rest = this.runs.columns.slice(kNamed, -1).map((column) => text_of(this.value(index, column)));
    return [text_of(this.value(index, "run")), this.runs.variants[Number(this.value(index, "variant"))] ?? "?", name, family, ...rest];
  }

  private sort(column: number, ascending: boolean): void {
    const keys = new Map(this.chosen.map((index) => [index, this.texts(index)[column] ?? ""]));
    this.chosen.sort((a, b) => (ascending ? 1 : -1) * compare_texts(keys.get(a) ?? "", keys.get(b) ?? "") || a - b);
    this.begin();
  }

  private begin(): void {
    this.body.replaceChildren();
    this.shown = 0;
    this.show_more();
  }

  private show_more(): void {
    for (const index of this.chosen.slice(this.shown, this.shown + kRows)) this.body.append(this.row(index));
    this.shown = Math.min(this.shown + kRows, this.chosen.length);
    this.more.hidden = this.shown >= this.chosen.length;
  }

  private row(index: number): HTMLTableRowElement {
    const failed = this.value(index, "success") === false;
    const row = element("tr", failed ? { class: "failed" } : {});
    const kept = this.kept(index);
    this.texts(index).forEach((text, column) => {
      const cell = element("td", {}, column === 0 ? "" : text);
      if (column === 0) cell.append(kept ? link_to(kept, text) : text);
      row.append(cell);
    });
    return row;
  }
}

function link_to(kept: { recording: string; report: string }, text: string): HTMLElement {
  const where = kept.report === "" ? kept.recording : kept.report;
  return element("a", { href: where.split("/").map(encodeURIComponent).join("/"), title: kept.report === "" ? "Its recording" : "Its report" }, text);
}

function text_of(value: Value): string {
  if (value === null) return "–";
  if (typeof value === "boolean") return value ? "yes" : "no";
  return typeof value === "number" && !Number.isInteger(value) ? value.toFixed(2) : String(value);
}
