// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <fstream>

#include "clew/bisect_output.hpp"
#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/own_program.hpp"
#include "clew/plugin_options.hpp"
#include "clew/property_option.hpp"
#include "hunt/bisect.hpp"
#include "hunt/version_bisect.hpp"
#include "recording/run_recording.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using core::Result;
using hunt::Property;

struct BisectCommandOptions {
  std::string a;
  std::string b;
  std::string version;  ///< another build of this command
  bool ticks = false;
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

/// 0 if something was found, 1 if not.
template <typename End>
int finish(const Result<End>& end, bool found, const BisectCommandOptions& options,
           const BisectNames& names) {
  if (!end.ok()) return complain(end.error());
  if (end->interrupted) return kExitInterrupted;
  if (options.json) {
    print_json(*end, names);
  } else {
    print_words(*end, names);
  }
  return found ? kExitGood : kExitFailed;
}

/// Whether one of the differences matters.
bool found_one(const Result<hunt::BisectEnd>& end) {
  return end.ok() &&
         ((!end->differences.empty() && end->differences.front().first) || !end->cause.empty());
}

int bisect_settings(const BisectCommandOptions& options, const std::optional<Property>& property) {
  const auto a = read_side(options.a, options);
  if (!a.ok()) return complain(a.error());
  const auto b = read_side(options.b, options);
  if (!b.ok()) return complain(b.error());
  const auto end = hunt::bisect(*a, *b, property, stages::all());
  return finish(end, found_one(end), options, {options.a, options.b, property.has_value(), 0.0});
}

int bisect_ticks(const BisectCommandOptions& options, const std::optional<Property>& property) {
  const auto recording = bridge::RunRecording::open(options.a);
  if (!recording.ok()) return complain(recording.error());
  const auto plugins = load_plugins_for(*recording, options.plugins);
  if (!plugins.ok()) return complain(plugins.error());
  const auto recorded = bridge::recorded_plan(*recording, stages::all());
  if (!recorded.ok()) return complain(recorded.error());
  const auto changed = bridge::changed_plan(*recording, options.overrides,
                                            runtime::ConfigPath::from_environment(), stages::all());
  if (!changed.ok()) return complain(changed.error());
  const auto end = hunt::bisect_ticks(*recording, *recorded, *changed, property);
  return finish(end, end.ok() && end->last_tick, options,
                {options.a, {}, property.has_value(), recorded->graph.tick_s});
}

int bisect_versions(const BisectCommandOptions& options, const std::optional<Property>& property) {
  const auto a = read_side(options.a, options);
  if (!a.ok()) return complain(a.error());
  const auto plan = runtime::prepare_run(a->bundle, stages::all());
  if (!plan.ok()) return complain(plan.error());
  const auto end = hunt::bisect_versions(*plan, {own_program(), options.version}, property);
  return finish(end, found_one(end), options,
                {options.a, options.version, property.has_value(), 0.0, true});
}

/// Each form of the command takes its own options.
Result<void> check_options(const BisectCommandOptions& options) {
  const auto& overrides = options.overrides;
  const bool has_change = !overrides.with.empty() || !overrides.set.empty();
  if (options.ticks && !options.version.empty()) {
    return core::Error{"--ticks and --other-version ask different questions: give one"};
  }
  if (options.ticks || !options.version.empty()) {
    if (!options.b.empty()) {
      return core::Error{fmt::format("{} takes one run; found a second, '{}'",
                                     options.ticks ? "--ticks" : "--other-version", options.b)};
    }
  } else if (options.b.empty()) {
    return core::Error{
        "b is required; 'clew bisect A B' compares two runs, 'clew bisect A --ticks --with ...' "
        "asks when a change is too late, 'clew bisect A --other-version PROGRAM' which component "
        "of "
        "another version matters"};
  }
  if (options.ticks != has_change) {
    return core::Error{options.ticks
                           ? "--ticks needs the change: --with or --set"
                           : "--with and --set are the change of --ticks; found no --ticks"};
  }
  if (options.ticks && (overrides.world || overrides.robot || overrides.seed)) {
    return core::Error{"--ticks goes on from a recording: --world, --robot and --seed are its own"};
  }
  if (options.ticks && overrides.max_ticks) {
    return core::Error{
        "--ticks compares with the recorded run, which has its own --max-ticks; found "
        "another: leave it out"};
  }
  return {};
}

int bisect_command(const BisectCommandOptions& options) {
  if (const auto checked = check_options(options); !checked.ok()) return complain(checked.error());
  std::optional<Property> property;
  if (!options.property.empty()) {
    auto read = read_property(options.property);
    if (!read.ok()) return complain(read.error());
    property = std::move(read).value();
  }
  if (options.ticks) return bisect_ticks(options, property);
  if (!options.version.empty()) return bisect_versions(options, property);
  return bisect_settings(options, property);
}

}  // namespace

void add_bisect(CLI::App& main, int& status) {
  const auto options = std::make_shared<BisectCommandOptions>();
  CLI::App* app =
      main.add_subcommand("bisect", "Find which setting, tick or version makes two runs differ");
  app->add_option("a", options->a, "a recording, or a graph's name or path")->required();
  app->add_option("b", options->b, "another");
  app->add_flag("--ticks", options->ticks,
                "when it is too late for --with and --set in the recording a");
  app->add_option("--other-version", options->version,
                  "which component of another build of clew matters: a PROGRAM");
  add_property(*app, options->property);
  add_overrides(*app, options->overrides);
  add_plugins(*app, options->plugins);
  app->add_flag("--json", options->json, "print it as one JSON object");
  app->callback([options, &status] { status = bisect_command(*options); });
}

}  // namespace clew::tools
