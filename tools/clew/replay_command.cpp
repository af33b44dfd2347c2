// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <future>
#include <nlohmann/json.hpp>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/difference_output.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/plugin_options.hpp"
#include "clew/replay_branch.hpp"
#include "clew/replay_options.hpp"
#include "clew/replay_output.hpp"
#include "clew/replay_publish.hpp"
#include "log/log.hpp"
#include "replay/component_replay.hpp"
#include "replay/playback.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using bridge::ReplayReport;
using core::Error;
using core::Result;
using nlohmann::ordered_json;

Result<void> check_options(const ReplayOptions& options) {
  if (options.recording.empty()) {
    return Error{options.publishes ? "no recording; --publish takes what follows it for topics: "
                                     "'clew replay RECORDING --publish [TOPIC...]'"
                                   : "no recording; expected 'clew replay RECORDING [OPTIONS]'"};
  }
  if (options.branch_tick && (options.first_tick || options.last_tick)) {
    return Error{"--branch goes on to the end of the run: leave out --from and --to"};
  }
  if (!options.branch_tick &&
      (!options.record.empty() || options.force || options.overrides.max_ticks)) {
    return Error{"--record, --force and --max-ticks need --branch"};
  }
  if (options.publishes && options.branch_tick) {
    return Error{"--publish feeds what is recorded, --branch goes on from it: leave out one"};
  }
  if (!options.exec.empty() && !options.start && !options.branch_tick) {
    return Error{"needs --start or --branch", "--exec"};
  }
  if (!options.publishes && (options.domain || options.start || !options.prefix.empty() ||
                             !options.readers.empty() || options.wait_s || options.start_paused ||
                             options.commands || options.loop || !options.remap.empty())) {
    return Error{
        "--domain, --start, --prefix, --reader, --wait, --start-paused, --commands, --loop and "
        "--remap need --publish"};
  }
  return {};
}

/// The topics of a stage that the user left out of the recording, in words.
std::string left_out_of(const runtime::GraphStage& stage, const bridge::RunRecording& recording) {
  std::string names;
  for (const domain::Topic topic : recording.description().left_out) {
    const bool needed = (stage.ports.all_inputs() | stage.ports.outputs)[index_of(topic)];
    if (needed)
      names += fmt::format("{}'{}'", names.empty() ? "" : ", ", domain::topic_name(topic));
  }
  return names;
}

/// The stages to replay: the one asked for, or all that are ours.
std::vector<std::string> stages_of(const ReplayOptions& options, const runtime::Graph& graph,
                                   const bridge::RunRecording& recording) {
  if (!options.component.empty()) return {options.component};
  std::vector<std::string> names;
  for (const auto& stage : graph.stages) {
    const std::string lacking = left_out_of(stage, recording);
    if (!lacking.empty()) {
      logs::info("{} is left out: --record-topics left out {}", stage.info->name, lacking);
    } else if (stage.deployment.is_ours()) {
      names.push_back(stage.info->name);
    } else {
      logs::info("{} is a {}, and is left out", stage.info->name,
                 stage.deployment.ros2 ? "robot of ROS 2" : "third-party component");
    }
  }
  return names;
}

/// All components in one object: the earliest difference, and the slowest one's speed.
ordered_json to_json(const std::vector<ReplayReport>& reports) {
  const ReplayReport* first = nullptr;
  double ticks_per_s = reports.front().ticks_per_s;
  ordered_json components = ordered_json::array();
  for (const ReplayReport& report : reports) {
    ticks_per_s = std::min(ticks_per_s, report.ticks_per_s);
    if (report.first && (first == nullptr || report.first->tick < first->first->tick)) {
      first = &report;
    }
    components.push_back(replay_json(report));
  }
  return {{"component", nullptr},
          {"ticks", reports.front().ticks},
          {"identical", first == nullptr},
          {"first_difference", first == nullptr ? nullptr : difference_json(first->first)},
          {"ticks_per_s", ticks_per_s},
          {"components", std::move(components)}};
}

/// Each component of `changed` is fed what was recorded: its scans have the arrangement that they
/// had then, whatever sense would make of them now.
Result<std::vector<ReplayReport>> replay_all(const bridge::RunRecording& recording,
                                             const runtime::RunPlan& recorded,
                                             const runtime::RunPlan& changed,
                                             const ReplayOptions& options) {
  runtime::RunPlan plan = changed;
  plan.setup.behaviour.scan = recorded.setup.behaviour.scan;
  const auto branch = bridge::branch_of(recording);
  if (!branch.ok()) return branch.error();
  const std::uint64_t own_tick = *branch ? (*branch)->tick : 0;
  bridge::ReplayRange range;
  range.first_tick = options.first_tick.value_or(own_tick);
  if (options.last_tick) {
    CLEW_RETURN_IF_ERROR(bridge::check_last_tick(recording, *options.last_tick));
    range.last_tick = *options.last_tick;
  }
  range.rate = options.rate;
  if (!options.first_tick && own_tick > 0) {
    logs::info("{}: branched at tick {} off another run; compared from there", recording.path(),
               own_tick);
  }
  // At a rate they go on side by side, each on a thread of its own; else one after another.
  const auto policy = range.rate > 0.0 ? std::launch::async : std::launch::deferred;
  std::vector<std::future<Result<ReplayReport>>> replays;
  for (const std::string& stage : stages_of(options, plan.graph, recording)) {
    replays.push_back(std::async(policy, [&recording, &plan, &range, stage] {
      return bridge::replay_component(recording, plan, stage, range);
    }));
  }
  std::vector<ReplayReport> reports;
  for (auto& replay : replays) {
    auto report = replay.get();
    if (!report.ok()) return report.error();
    reports.push_back(std::move(report).value());
  }
  if (reports.empty() && !recording.description().left_out.empty()) {
    return Error{"holds too few topics of its run to replay a stage", recording.path()};
  }
  if (reports.empty()) return Error{"no component of this recording is ours"};
  return reports;
}

int replay_command(const ReplayOptions& options) {
  if (const auto checked = check_options(options); !checked.ok()) return complain(checked.error());
  const auto recording = bridge::RunRecording::open(options.recording);
  if (!recording.ok()) return complain(recording.error());
  const auto plugins = load_plugins_for(*recording, options.plugins);
  if (!plugins.ok()) return complain(plugins.error());
  const auto recorded = bridge::recorded_plan(*recording, stages::all());
  if (!recorded.ok()) return complain(recorded.error());
  const auto plan = bridge::changed_plan(*recording, options.overrides,
                                         runtime::ConfigPath::from_environment(), stages::all());
  if (!plan.ok()) return complain(plan.error());
  if (const std::string why = recording->cut_off(); !why.empty()) {
    logs::warning("{}: {}; used is what is there", recording->path(), why);
  }
  if (options.branch_tick) return replay_branch(options, *recording, *recorded, *plan);
  if (options.publishes) return replay_publish(options, *recording, *recorded, *plan);
  const auto reports = replay_all(*recording, *recorded, *plan, options);
  if (!reports.ok()) return complain(reports.error());
  bool identical = true;
  for (const ReplayReport& report : *reports) {
    identical = identical && report.identical();
    if (!options.json) print_replay(report);
  }
  if (options.json) {
    fmt::print("{}\n", json_line(options.component.empty() ? to_json(*reports)
                                                           : replay_json(reports->front())));
  }
  return identical ? kExitGood : kExitFailed;
}

void add_publish(CLI::App& app, ReplayOptions& options) {
  app.add_option("--publish", options.publish,
                 "put these TOPICs, or the inputs of --component, on the wire")
      ->expected(0, static_cast<int>(domain::kTopicCount));
  app.add_option("--domain", options.domain, "DDS domain, 0 to 99 (a free one)");
  app.add_option("--middleware", options.middleware, "cyclonedds | fastdds (cyclonedds)");
  app.add_flag("--start", options.start, "start the component's process, too");
  app.add_option("--prefix", options.prefix, "STAGE='gdb --args': start it under a command");
  app.add_option("--reader", options.readers, "start a COMMAND that reads; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--wait", options.wait_s,
                 "seconds to wait for readers (10; 60 if started by hand)")
      ->check(number_between(0.1, 86400.0));
  app.add_flag("--start-paused", options.start_paused, "wait before the first tick");
  app.add_flag("--loop", options.loop, "begin again after the last tick, until told to end");
  app.add_option("--remap", options.remap,
                 "TOPIC:=NAME: publish it under another name; may be repeated")
      ->allow_extra_args(false);
  app.add_flag("--commands", options.commands,
               "read pause, resume, step [N], seek TICK, rate N and end from stdin, a line each");
}

}  // namespace

void add_replay(CLI::App& main, int& status) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* app = main.add_subcommand("replay", "Feed a recording to its components and compare");
  app->add_option("recording", options->recording, "required");
  app->add_option("--component", options->component, "only this stage (all, each on its own)");
  app->add_option("--with", options->overrides.with, "STAGE[.PART]=NAME[,NAME...]: other behaviour")
      ->allow_extra_args(false);
  app->add_option("--set", options->overrides.set, "STAGE[.PART][.NAME].PARAM=VALUE: other value")
      ->allow_extra_args(false);
  add_plugins(*app, options->plugins);
  app->add_option("--from", options->first_tick, "compare from this tick")->check(whole_number());
  app->add_option("--to", options->last_tick, "end with this tick")->check(whole_number());
  app->add_option("--rate", options->rate, "simulated over wall-clock time (as fast as it goes)")
      ->check(number_between(bridge::Playback::kLowestRate, bridge::Playback::kHighestRate));
  app->add_option("--branch", options->branch_tick, "continue the run from this tick")
      ->check(whole_number());
  app->add_option(
         "--exec", options->exec,
         "with --branch, or --publish --start: a COMMAND of a component of someone else's, "
         "as the recording has it, else nothing is run; may be repeated")
      ->allow_extra_args(false);
  app->add_option("--record", options->record, "write a recording of the branch (MCAP)")
      ->check(given_name());
  app->add_flag("--force", options->force, "overwrite it");
  app->add_option("--max-ticks", options->overrides.max_ticks,
                  "time out the branch after this many ticks")
      ->check(whole_number());
  add_publish(*app, *options);
  app->add_flag("--json", options->json, "print the result as one JSON object");
  app->callback([app, options, &status] {
    options->publishes = app->count("--publish") > 0;
    // An option without a value is given as an empty one.
    if (options->publish == std::vector<std::string>{""}) options->publish.clear();
    status = replay_command(*options);
  });
}

}  // namespace clew::tools
