// SPDX-License-Identifier: Apache-2.0
// The page of a bench: charts and tables, each cell of which leads to its runs, each run that was
// kept to its report. One file, which needs neither server nor network.
import "./bench.css";

import { button, by_id, element } from "../elements";
import { embedded } from "../embedded";
import type { Bench, Cell, CellRuns, Table } from "./bench_data";
import { draw_chart } from "./charts";
import { RunsTable } from "./runs_table";
import { column_heads, compare_texts } from "./sortable";

type ShowRuns = (runs: CellRuns, of: string) => void;

function draw_cell(table: Table, row: Cell[], column: number, show_runs: ShowRuns): HTMLElement {
  const cell = row[column];
  const made = element(column === 0 ? "th" : "td", column === 0 ? { scope: "row" } : {});
  const runs = cell?.runs;
  const of = [row[0]?.text, column === 0 ? "" : table.columns[column]].filter((text) => text !== "" && text !== undefined).join(", ");
  if (cell && runs) made.append(button(cell.text === "" ? "–" : cell.text, "Show these runs", () => show_runs(runs, of)));
  else made.append(cell?.text ?? "");
  return made;
}

function draw_table(table: Table, show_runs: ShowRuns): HTMLElement {
  const body = element("tbody");
  const rows = table.rows.map((row) => ({
    row, made: element("tr", {}, ...table.columns.map((_, column) => draw_cell(table, row, column, show_runs))),
  }));
  const heads = column_heads(table.columns, (column, ascending) => {
    const text = (row: Cell[]): string => row[column]?.text ?? "";
    const sorted = [...rows].sort((a, b) => (ascending ? 1 : -1) * compare_texts(text(a.row), text(b.row)));
    body.replaceChildren(...sorted.map(({ made }) => made));
  });
  body.append(...rows.map(({ made }) => made));
  const section = element("section", { "data-table": table.title }, element("h2", {}, table.title));
  if (table.note !== "") section.append(element("p", { class: "faint" }, table.note));
  section.append(element("div", { class: "scroll" }, element("table", {}, element("thead", {}, heads), body)));
  return section;
}

/// As an image, so that nothing in a picture is part of this page.
function draw_picture({ caption, svg }: { caption: string; svg: string }): HTMLElement {
  const source = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  return element("figure", {}, element("img", { src: source, alt: caption, loading: "lazy" }), element("figcaption", {}, caption));
}

function show(bench: Bench): void {
  document.title = bench.title;
  const runs = new RunsTable(bench.runs);
  const show_runs: ShowRuns = (wanted, of) => runs.go_to(wanted, of);
  const page = by_id("bench");
  page.append(element("h1", {}, bench.title), element("p", {}, bench.about));
  for (const remark of bench.remarks) page.append(element("p", { class: "remark" }, remark));
  page.append(element("div", { class: "charts" }, ...bench.charts.map((chart) => draw_chart(chart, show_runs))));
  page.append(...bench.tables.map((table) => draw_table(table, show_runs)), runs.box);
  if (bench.pictures.length > 0) {
    page.append(element("section", { "aria-label": "Worst runs" }, element("h2", {}, "Worst runs"),
      element("div", { class: "pictures" }, ...bench.pictures.map(draw_picture))));
  }
  document.body.dataset["ready"] = "true";
}

const inside = embedded()[0]?.files[0];
if (inside) show(JSON.parse(new TextDecoder().decode(inside)) as Bench);
else by_id("bench").textContent = "This page holds no bench.";
