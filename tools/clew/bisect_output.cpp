// SPDX-License-Identifier: Apache-2.0
#include "clew/bisect_output.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "clew/json_line.hpp"
#include "clew/print_text.hpp"
#include "domain/topics.hpp"

namespace clew::tools {
namespace {

using hunt::BisectDifference;
using hunt::BisectEnd;
using hunt::FirstDifference;
using hunt::TickBisectEnd;
using hunt::TickProbe;
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

/// A difference as it is called in either question.
ordered_json alone_json(const BisectDifference& one, bool of_versions) {
  ordered_json json;
  if (of_versions) {
    json["stage"] = one.name;
  } else {
    json = {{"setting", one.name}, {"a", one.a}, {"b", one.b}};
  }
  json["first_difference"] = difference_json(one.first);
  json["outcome"] = one.outcome;
  json["changes_verdict"] = one.changes_verdict;
  json[of_versions ? "aborted" : "refused"] = one.refused;
  return json;
}

std::string values_of(const BisectDifference& one) {
  if (one.a.empty() && one.b.empty()) return "";
  return fmt::format(": {} -> {}", one.a.empty() ? "none" : one.a, one.b.empty() ? "none" : one.b);
}

void print_alone(const BisectDifference& one, bool of_versions) {
  const std::string effect =
      one.refused.empty() ? effect_of(one.first, one.outcome)
                          : (of_versions ? "no run: " : "cannot be changed alone: ") + one.refused;
  if (of_versions) return print_text("  {}: {}\n", one.name, effect);
  print_text("  {}{}\n    {}\n", one.name, values_of(one), effect);
}

}  // namespace

void print_json(const BisectEnd& end, const BisectNames& names) {
  ordered_json json = {{names.of_versions ? "outcome_own" : "outcome_a", end.outcome_a},
                       {names.of_versions ? "outcome_other" : "outcome_b", end.outcome_b},
                       {"verdicts_differ", end.verdicts_differ},
                       {"runs", end.runs}};
  json["first"] = nullptr;
  if (!end.differences.empty() && end.differences.front().first) {
    json["first"] = end.differences.front().name;
  }
  json["cause"] = ordered_json::array();
  for (const std::size_t index : end.cause) json["cause"].push_back(end.differences[index].name);
  auto& all = json[names.of_versions ? "stages" : "settings"] = ordered_json::array();
  for (const BisectDifference& one : end.differences) {
    all.push_back(alone_json(one, names.of_versions));
  }
  fmt::print("{}\n", json_line(json));
}

void print_words(const BisectEnd& end, const BisectNames& names) {
  print_text("a: {}: {}\nb: {}{}: {}\n", names.a, end.outcome_a,
             names.of_versions ? "all components by " : "", names.b, end.outcome_b);
  if (end.differences.empty()) {
    print_text("the two do not differ in any setting\n");
    return;
  }
  if (names.of_versions) {
    print_text("\neach component by {}, alone, the first that matters first:\n", names.b);
  } else {
    print_text("\neach of b's settings in a, alone, the first that matters first:\n");
  }
  for (const BisectDifference& one : end.differences) print_alone(one, names.of_versions);
  if (!end.verdicts_differ) {
    print_text("\nthe {} is the same\n", compared(names));
    return;
  }
  print_text("\nb's {} needs {}:\n", compared(names),
             end.cause.size() == 1 ? "this one" : "these together");
  for (const std::size_t index : end.cause) print_text("  {}\n", end.differences[index].name);
}

void print_json(const TickBisectEnd& end, const BisectNames&) {
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

}  // namespace clew::tools
