// SPDX-License-Identifier: Apache-2.0
#include "clew/replay_output.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "clew/difference_output.hpp"
#include "clew/terminal.hpp"

namespace clew::tools {

using bridge::ReplayReport;
using nlohmann::ordered_json;

namespace {

ordered_json inputs_json(const ReplayReport& report) {
  if (report.identical()) return nullptr;
  ordered_json inputs = ordered_json::object();
  for (const auto& input : report.inputs) {
    ordered_json fields = ordered_json::object();
    for (const auto& field : input.fields) fields[field.path] = value_json(field.value);
    inputs[std::string(domain::topic_name(input.topic))] = std::move(fields);
  }
  return inputs;
}

}  // namespace

ordered_json replay_json(const ReplayReport& report) {
  return {{"component", report.component},     {"ticks", report.ticks},
          {"identical", report.identical()},   {"first_difference", difference_json(report.first)},
          {"ticks_per_s", report.ticks_per_s}, {"different_ticks", report.different_ticks},
          {"has_past", report.has_past},       {"inputs", inputs_json(report)}};
}

void print_replay(const ReplayReport& report) {
  if (!report.has_past) {
    fmt::print("{}: begins where the black box does, which has no state of this behaviour\n",
               report.component);
  }
  if (report.identical()) {
    fmt::print("{}: {} ticks {}, {:.0f} ticks/s\n", report.component, report.ticks,
               in_colour("identical", Tone::kGood), report.ticks_per_s);
    return;
  }
  fmt::print("{}: {} of {} ticks differ, {:.0f} ticks/s\n", report.component,
             report.different_ticks, report.ticks, report.ticks_per_s);
  print_difference(*report.first, "recorded", "replayed");
  fmt::print("  with these inputs:\n");
  for (const auto& input : report.inputs) {
    print_fields(fmt::format("    {}.", domain::topic_name(input.topic)), input.fields);
  }
}

}  // namespace clew::tools
