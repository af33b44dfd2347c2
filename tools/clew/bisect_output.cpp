// SPDX-License-Identifier: Apache-2.0
#include "clew/bisect_output.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "clew/json_line.hpp"
#include "clew/print_text.hpp"
#include "domain/topics.hpp"

namespace clew::tools {
namespace {

using hunt::BisectEnd;
using hunt::BisectSetting;
using hunt::FirstDifference;
using hunt::TickBisectEnd;
using hunt::TickProbe;
using hunt::VersionBisectEnd;
using hunt::VersionStage;
using nlohmann::ordered_json;

ordered_json difference_json(const std::optional<FirstDifference>& first) {
  if (!first) return nullptr;
  return {{"tick", first->tick}, {"topic", domain::topic_name(first->topic)}};
}

ordered_json probe_json(const TickProbe& probe) {
  return {{"tick", probe.tick}, {"outcome", probe.outcome}, {"verdict", probe.verdict}};
}

std::string effect_of(const std::optional<FirstDifference>& first, const std::string& outcome) {
  if (!first) return "makes no difference";
  return fmt::format("first difference at tick {}, {}; outcome {}", first->tick,
                     domain::topic_name(first->topic), outcome);
}

const char* compared(const BisectNames& names) {
  return names.has_property ? "verdict" : "outcome";
}

void print_cause(const BisectNames& names, const std::vector<std::string>& cause) {
  print_text("\nb's {} needs {}:\n", compared(names),
             cause.size() == 1 ? "this one" : "these together");
  for (const std::string& name : cause) print_text("  {}\n", name);
}

}  // namespace

void print_json(const BisectEnd& end) {
  ordered_json json = {{"outcome_a", end.outcome_a},
                       {"outcome_b", end.outcome_b},
                       {"verdicts_differ", end.verdicts_differ},
                       {"runs", end.runs}};
  json["first"] = nullptr;
  if (!end.settings.empty() && end.settings.front().first) {
    json["first"] = end.settings.front().name;
  }
  json["cause"] = ordered_json::array();
  for (const std::size_t index : end.cause) json["cause"].push_back(end.settings[index].name);
  json["settings"] = ordered_json::array();
  for (const BisectSetting& setting : end.settings) {
    json["settings"].push_back({{"setting", setting.name},
                                {"a", setting.a},
                                {"b", setting.b},
                                {"first_difference", difference_json(setting.first)},
                                {"outcome", setting.outcome},
                                {"changes_verdict", setting.changes_verdict},
                                {"refused", setting.refused}});
  }
  fmt::print("{}\n", json_line(json));
}

void print_words(const BisectEnd& end, const BisectNames& names) {
  print_text("a: {}: {}\nb: {}: {}\n", names.a, end.outcome_a, names.b, end.outcome_b);
  if (end.settings.empty()) {
    print_text("the two do not differ in any setting\n");
    return;
  }
  print_text("\neach of b's settings in a, alone, the first that matters first:\n");
  for (const BisectSetting& setting : end.settings) {
    const bool has_values = !setting.a.empty() || !setting.b.empty();
    print_text("  {}{}\n    {}\n", setting.name,
               has_values ? fmt::format(": {} -> {}", setting.a.empty() ? "none" : setting.a,
                                        setting.b.empty() ? "none" : setting.b)
                          : std::string(),
               setting.refused.empty() ? effect_of(setting.first, setting.outcome)
                                       : "cannot be changed alone: " + setting.refused);
  }
  if (!end.verdicts_differ) {
    print_text("\nthe {} is the same\n", compared(names));
    return;
  }
  std::vector<std::string> cause;
  for (const std::size_t index : end.cause) cause.push_back(end.settings[index].name);
  print_cause(names, cause);
}

void print_json(const TickBisectEnd& end) {
  ordered_json json = {{"unchanged", probe_json(end.unchanged)}, {"last_tick", nullptr}};
  if (end.last_tick) json["last_tick"] = *end.last_tick;
  json["turns"] = end.turns;
  json["probes"] = ordered_json::array();
  for (const TickProbe& probe : end.probes) json["probes"].push_back(probe_json(probe));
  fmt::print("{}\n", json_line(json));
}

void print_words(const TickBisectEnd& end, const BisectNames& names) {
  print_text("{}: {}\n\nwith the change, from this tick on:\n", names.a, end.unchanged.verdict);
  std::string before;
  for (std::size_t i = 0; i < end.probes.size(); ++i) {
    const TickProbe& probe = end.probes[i];
    const bool turns_next =
        i + 1 == end.probes.size() || end.probes[i + 1].verdict != probe.verdict;
    // What is between two equal ones says nothing new.
    if (probe.verdict == before && !turns_next) continue;
    print_text("  {:>8}  {}\n", probe.tick, probe.verdict);
    before = probe.verdict;
  }
  if (!end.last_tick) {
    print_text("\nthe {} is the same at every tick that was tried\n", compared(names));
    return;
  }
  print_text("\nthe last tick at which it gives another {}: {} ({:.1f} s)\n", compared(names),
             *end.last_tick, static_cast<double>(*end.last_tick) * names.tick_s);
  if (end.turns > 1) {
    print_text(
        "it turned {} times among the evenly spaced ticks, so earlier is not always the "
        "same\n",
        end.turns);
  }
}

void print_json(const VersionBisectEnd& end) {
  ordered_json json = {{"outcome_own", end.outcome_own},
                       {"outcome_other", end.outcome_other},
                       {"verdicts_differ", end.verdicts_differ},
                       {"runs", end.runs}};
  json["first"] = nullptr;
  if (!end.stages.empty() && end.stages.front().first) json["first"] = end.stages.front().stage;
  json["cause"] = ordered_json::array();
  for (const std::size_t index : end.cause) json["cause"].push_back(end.stages[index].stage);
  json["stages"] = ordered_json::array();
  for (const VersionStage& stage : end.stages) {
    json["stages"].push_back({{"stage", stage.stage},
                              {"first_difference", difference_json(stage.first)},
                              {"outcome", stage.outcome},
                              {"changes_verdict", stage.changes_verdict},
                              {"aborted", stage.aborted}});
  }
  fmt::print("{}\n", json_line(json));
}

void print_words(const VersionBisectEnd& end, const BisectNames& names) {
  print_text("a: {}: {}\nb: all components by {}: {}\n", names.a, end.outcome_own, names.b,
             end.outcome_other);
  print_text("\neach component by {}, alone, the first that matters first:\n", names.b);
  for (const VersionStage& stage : end.stages) {
    print_text(
        "  {}: {}\n", stage.stage,
        stage.aborted.empty() ? effect_of(stage.first, stage.outcome) : "no run: " + stage.aborted);
  }
  if (!end.verdicts_differ) {
    print_text("\nthe {} is the same\n", compared(names));
    return;
  }
  std::vector<std::string> cause;
  for (const std::size_t index : end.cause) cause.push_back(end.stages[index].stage);
  print_cause(names, cause);
}

}  // namespace clew::tools
