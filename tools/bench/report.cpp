// SPDX-License-Identifier: Apache-2.0
#include "bench/report.hpp"

#include <fmt/format.h>

#include <array>

#include "bench/barn.hpp"
#include "bench/coverage.hpp"
#include "bench/groups.hpp"
#include "bench/pairs.hpp"

namespace clew::bench {
namespace {

constexpr char kStyle[] =
    "body{font:14px sans-serif;margin:2em;max-width:100em}table{border-collapse:collapse}"
    "td,th{border:1px solid #ccc;padding:3px 8px;text-align:left}th{background:#eee}"
    "figure{display:inline-block;margin:1em;width:30em;vertical-align:top}img{width:100%}";

std::string replaced(const std::string& text, const char* characters,
                     const std::vector<std::string>& replacements) {
  const std::string special = characters;
  std::string out;
  for (const char c : text) {
    const std::size_t index = special.find(c);
    out += index == std::string::npos ? std::string(1, c) : replacements[index];
  }
  return out;
}

std::string markdown_cell(const std::string& text) { return replaced(text, "|", {"\\|"}); }

std::string html_text(const std::string& text) {
  return replaced(text, "&<>\"", {"&amp;", "&lt;", "&gt;", "&quot;"});
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  return '"' + replaced(text, "\"", {"\"\""}) + '"';
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += ' ' + markdown_cell(cell) + " |";
  return text + '\n';
}

std::string html_row(const std::vector<std::string>& cells, const char* tag) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, html_text(cell));
  return text + "</tr>\n";
}

std::string html_table(const Table& table) {
  std::string text = "<h2>" + html_text(table.title) + "</h2>\n";
  if (!table.note.empty()) text += "<p>" + html_text(table.note) + "</p>\n";
  text += "<table>\n" + html_row(table.columns, "th");
  for (const auto& row : table.rows) text += html_row(row, "td");
  return text + "</table>\n";
}

std::string number_or_nothing(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "";
}

std::string severity_cells(const std::optional<RunResult::Severity>& severity) {
  if (!severity) return ",,,,";
  return fmt::format("{},{},{},{:.4f},{:.4f}", number_or_nothing(severity->deepest_ranges),
                     severity->nested_pockets, number_or_nothing(severity->backtrack_ranges),
                     severity->bug1_bound_m, severity->bug2_bound_m);
}

}  // namespace

Report make_report(const BenchResults& results, std::vector<Picture> pictures) {
  const BenchPlan& plan = *results.plan;
  Report report;
  report.title = fmt::format("Suite {}: {} runs", plan.suite, results.runs.size());
  report.about = fmt::format("{}{}{} worlds, {} seeds, at most {} ticks.", plan.about,
                             plan.about.empty() ? "" : " ", plan.worlds.size(), plan.seeds.size(),
                             plan.configuration.at("max_ticks"));
  report.remarks = remarks_on(results);
  Table barn = barn_table(results);
  if (!barn.rows.empty()) report.tables.push_back(std::move(barn));
  report.tables.push_back(overall_table(results));
  for (const Grouping by : plan.by) report.tables.push_back(group_table(results, by));
  report.asked_for = report.tables.size();
  if (plan.stopping) report.tables.push_back(sequential_table(results));
  for (Table& table : matrix_tables(results)) report.tables.push_back(std::move(table));
  report.tables.push_back(family_table(results));
  if (plan.by.empty()) report.tables.push_back(group_table(results, Grouping::kSeverity));
  report.tables.push_back(detector_table(results));
  for (Table& table :
       std::array{bug_table(results), paired_graphs_table(results), paired_table(results)}) {
    if (!table.rows.empty()) report.tables.push_back(std::move(table));
  }
  report.covers = plan.coverage;
  if (report.covers) report.tables.push_back(coverage_table(results));
  report.pictures = std::move(pictures);
  return report;
}

std::string to_markdown(const Table& table) {
  std::string text = "## " + table.title + '\n';
  if (!table.note.empty()) text += table.note + '\n';
  text += '\n' + markdown_row(table.columns) + '|';
  for (std::size_t i = 0; i < table.columns.size(); ++i) text += "---|";
  text += '\n';
  for (const auto& row : table.rows) text += markdown_row(row);
  return text;
}

std::string to_markdown(const Report& report) {
  std::string text = "# " + report.title + '\n' + report.about + '\n';
  for (const std::string& remark : report.remarks) text += '\n' + remark + '\n';
  for (const Table& table : report.tables) text += '\n' + to_markdown(table);
  if (!report.pictures.empty()) text += "\n## Worst runs\n";
  for (const Picture& picture : report.pictures) {
    text += fmt::format("\n{0}\n\n![{0}]({1})\n", picture.caption, picture.file);
  }
  return text;
}

std::string to_html(const Report& report) {
  std::string text = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                     html_text(report.title) + "</title><style>" + kStyle +
                     "</style></head><body>\n<h1>" + html_text(report.title) + "</h1>\n<p>" +
                     html_text(report.about) + "</p>\n";
  for (const std::string& remark : report.remarks) text += "<p>" + html_text(remark) + "</p>\n";
  for (const Table& table : report.tables) text += html_table(table);
  if (!report.pictures.empty()) text += "<h2>Worst runs</h2>\n";
  for (const Picture& picture : report.pictures) {
    text += fmt::format(
        "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"\"></a><figcaption>{1}</figcaption>"
        "</figure>\n",
        html_text(picture.file), html_text(picture.caption));
  }
  return text + "</body></html>\n";
}

std::string csv_header() {
  return "graph,variant,family,world,seed,outcome,success,solvable,ticks,sim_time_s,path_length_m,"
         "shortest_path_m,path_ratio,severity_ranges,nested_pockets,necessary_backtrack_ranges,"
         "bug1_bound_m,bug2_bound_m,collisions,hit_by,safety_stops,captures,held_at_end,alarms,"
         "false_alarms,hash\n";
}

std::string csv_row(const RunResult& run) {
  std::uint32_t alarms = 0;
  std::uint32_t false_alarms = 0;
  for (const auto& detector : run.detectors) {
    if (detector.shadow) continue;
    alarms += detector.alarms;
    false_alarms += detector.false_alarms;
  }
  return fmt::format("{},{},{},{},{},{},{},{},{},{:.4f},{:.4f},{},{},{},{},{},{},{},{},{},{},{}\n",
                     csv_cell(run.key.graph), csv_cell(run.key.variant), csv_cell(run.family),
                     csv_cell(run.key.world), run.key.seed, run.outcome,
                     run.success ? fmt::format("{}", *run.success) : "",
                     run.solvable ? fmt::format("{}", *run.solvable) : "", run.ticks,
                     run.sim_time_s, run.path_length_m, number_or_nothing(run.shortest_path_m),
                     number_or_nothing(run.path_ratio()), severity_cells(run.severity),
                     run.collisions, run.hit_by, run.safety_stops,
                     run.captures ? fmt::format("{}", *run.captures) : "", run.held_at_end, alarms,
                     false_alarms, run.hash);
}

}  // namespace clew::bench
