// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/plugin_options.hpp"
#include "clew/property_option.hpp"
#include "hunt/bisect.hpp"
#include "recording/run_recording.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using core::Result;
using hunt::BisectEnd;
using hunt::BisectSetting;
using nlohmann::ordered_json;

struct BisectCommandOptions {
  std::string a;
  std::string b;
  std::string property;
  std::vector<std::string> plugins;
  runtime::GraphOverrides overrides;
  bool json = false;
};

/// By its first bytes, as `file` does it.
bool is_recording(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  char magic[5] = {};
  file.read(magic, sizeof magic);
  return file && std::string(magic, sizeof magic) == "\x89MCAP";
}

Result<runtime::Bundle> bundle_of_recording(const std::string& path,
                                            const BisectCommandOptions& options) {
  const auto recording = bridge::RunRecording::open(path);
  if (!recording.ok()) return recording.error();
  CLEW_RETURN_IF_ERROR(load_plugins_for(*recording, options.plugins));
  if (!recording->interventions().empty()) {
    return core::Error{
        "was changed while it ran, and is made again without that; bisect compares "
        "runs that follow from their settings",
        path};
  }
  const auto& overrides = options.overrides;
  if (overrides.world || overrides.robot || overrides.seed || overrides.max_ticks) {
    return core::Error{
        "has its own world, robot, seed and ticks; --world, --robot, --seed and "
        "--max-ticks are for graphs",
        path};
  }
  return recording->description().bundle;
}

Result<hunt::BisectSide> read_side(const std::string& name, const BisectCommandOptions& options) {
  if (is_recording(name)) {
    auto bundle = bundle_of_recording(name, options);
    if (!bundle.ok()) return bundle.error();
    return hunt::BisectSide{name, std::move(bundle).value()};
  }
  CLEW_RETURN_IF_ERROR(load_plugins_of(options.plugins, name));
  auto plan = runtime::prepare_run(name, options.overrides, runtime::ConfigPath::from_environment(),
                                   stages::all());
  if (!plan.ok()) return plan.error();
  return hunt::BisectSide{name, std::move(plan->bundle)};
}

ordered_json to_json(const BisectEnd& end) {
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
    ordered_json one = {{"setting", setting.name}, {"a", setting.a}, {"b", setting.b}};
    one["first_difference"] = nullptr;
    if (setting.first) {
      one["first_difference"] = {{"tick", setting.first->tick},
                                 {"topic", domain::topic_name(setting.first->topic)}};
    }
    one["outcome"] = setting.outcome;
    one["changes_verdict"] = setting.changes_verdict;
    one["refused"] = setting.refused;
    json["settings"].push_back(std::move(one));
  }
  return json;
}

std::string effect_of(const BisectSetting& setting) {
  if (!setting.refused.empty()) return "cannot be changed alone: " + setting.refused;
  if (!setting.first) return "makes no difference";
  return fmt::format("first difference at tick {}, {}; outcome {}", setting.first->tick,
                     domain::topic_name(setting.first->topic), setting.outcome);
}

void print(const BisectEnd& end, const BisectCommandOptions& options) {
  fmt::print("a: {}: {}\nb: {}: {}\n", options.a, end.outcome_a, options.b, end.outcome_b);
  if (end.settings.empty()) {
    fmt::print("the two do not differ in any setting\n");
    return;
  }
  fmt::print("\neach of b's settings in a, alone, the first that matters first:\n");
  for (const BisectSetting& setting : end.settings) {
    const bool has_values = !setting.a.empty() || !setting.b.empty();
    fmt::print("  {}{}\n    {}\n", setting.name,
               has_values ? fmt::format(": {} -> {}", setting.a.empty() ? "none" : setting.a,
                                        setting.b.empty() ? "none" : setting.b)
                          : std::string(),
               effect_of(setting));
  }
  const char* const what = options.property.empty() ? "outcome" : "verdict";
  if (!end.verdicts_differ) {
    fmt::print("\nthe {} is the same\n", what);
    return;
  }
  fmt::print("\nb's {} needs {}:\n", what, end.cause.size() == 1 ? "this one" : "these together");
  for (const std::size_t index : end.cause) fmt::print("  {}\n", end.settings[index].name);
}

int bisect_command(const BisectCommandOptions& options) {
  std::optional<hunt::Property> property;
  if (!options.property.empty()) {
    auto read = read_property(options.property);
    if (!read.ok()) return complain(read.error());
    property = std::move(read).value();
  }
  const auto a = read_side(options.a, options);
  if (!a.ok()) return complain(a.error());
  const auto b = read_side(options.b, options);
  if (!b.ok()) return complain(b.error());
  const auto end = hunt::bisect(*a, *b, property, stages::all());
  if (!end.ok()) return complain(end.error());
  if (end->interrupted) return kExitInterrupted;
  if (options.json) {
    fmt::print("{}\n", json_line(to_json(*end)));
  } else {
    print(*end, options);
  }
  const bool found = !end->settings.empty() && end->settings.front().first.has_value();
  return found || !end->cause.empty() ? kExitGood : kExitFailed;
}

}  // namespace

void add_bisect(CLI::App& main, int& status) {
  const auto options = std::make_shared<BisectCommandOptions>();
  CLI::App* app = main.add_subcommand("bisect", "Find which setting makes two runs differ");
  app->add_option("a", options->a, "a recording, or a graph's name or path")->required();
  app->add_option("b", options->b, "another")->required();
  add_property(*app, options->property);
  app->add_option("--world", options->overrides.world, "another world for both graphs");
  app->add_option("--robot", options->overrides.robot, "another robot for both graphs");
  app->add_option("--seed", options->overrides.seed, "of both graphs' runs (1)")
      ->check(whole_number());
  app->add_option("--max-ticks", options->overrides.max_ticks,
                  "time out after this many ticks (20000)")
      ->check(CLI::PositiveNumber);
  add_plugins(*app, options->plugins);
  app->add_flag("--json", options->json, "print it as one JSON object");
  app->callback([options, &status] { status = bisect_command(*options); });
}

}  // namespace clew::tools
