// SPDX-License-Identifier: Apache-2.0
#include "clew/fleet_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "clew/exit_status.hpp"
#include "clew/fleet_processes.hpp"
#include "clew/json_line.hpp"
#include "clew/plugin_options.hpp"
#include "clew/print_text.hpp"
#include "clew/run_layout.hpp"
#include "clew/run_output.hpp"
#include "clew/terminal.hpp"
#include "fleet/fleet_file.hpp"
#include "fleet/fleet_plan.hpp"
#include "fleet/fleet_run.hpp"
#include "log/log.hpp"
#include "runtime/config_source.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;
using fleet::FleetReport;
using fleet::RobotReport;
using nlohmann::ordered_json;

/// What a run of one graph can, and a fleet cannot.
Result<void> check_options(const RunOptions& options) {
  const auto& overrides = options.overrides;
  const std::vector<std::pair<bool, const char*>> others = {
      {overrides.world.has_value(), "--world"},
      {overrides.robot.has_value(), "--robot"},
      {!overrides.with.empty(), "--with"},
      {!overrides.set.empty(), "--set"},
      {overrides.goals.has_value(), "--goal"},
      {!options.pace.empty() && options.pace != "lockstep", "--pace"},
      {options.domain.has_value(), "--domain"},
      {!options.name.empty(), "--name"},
      {!options.at.empty(), "--at"},
      {options.realtime_priority.has_value(), "--realtime-priority"},
      {!options.exec.empty(), "--exec"},
      {!options.record_topics.empty(), "--record-topics"},
      {options.split_bytes > 0, "--split-size"},
      {options.split_s > 0.0, "--split-s"},
      {!options.record_on.empty(), "--record-on"},
      {options.record_last_s.has_value(), "--record-last"},
      {!options.compression.empty(), "--compression"},
      {options.on_record_error != "stop", "--on-record-error"},
      {!options.external.empty(), "--external"},
      {!options.hosts.empty(), "--hosts"},
      {!options.host.empty(), "--host"},
      {options.fallback != "none", "--fallback"},
      {!options.prefix.empty(), "--prefix"},
      {options.no_hash, "--no-hash"},
      {!options.profile.empty(), "--profile"},
      {!options.ros2.empty(), "--ros2"},
      {options.view.has_value(), "--view"}};
  for (const auto& [given, option] : others) {
    if (!given) continue;
    return Error{
        "is of a single robot, and this is a fleet; allowed: --record, --force, --threads, --seed, "
        "--max-ticks, --layout, --middleware, --secure, --plugin and --json, and in the file what "
        "each robot sets",
        option};
  }
  if (options.layout != "processes" && (!options.middleware.empty() || !options.secure.empty())) {
    return Error{"needs --layout processes", options.secure.empty() ? "--middleware" : "--secure"};
  }
  return {};
}

/// How each robot is laid out, in their order.
Result<std::vector<bridge::ProcessLayout>> layouts_of(const RunOptions& options,
                                                      const fleet::FleetPlan& plan) {
  std::vector<bridge::ProcessLayout> layouts;
  for (const fleet::RobotPlan& robot : plan.robots()) {
    auto layout = read_layout(options, robot.plan.graph, {});
    if (!layout.ok()) return layout.error();
    layouts.push_back(std::move(layout).value());
  }
  return layouts;
}

/// The report of one robot, as that of a run.
bridge::RunReport report_of(const RobotReport& robot, const FleetReport& fleet) {
  bridge::RunReport report;
  report.statistics = robot.statistics;
  const auto& truth = robot.statistics.truth;
  const bool has_outcome = truth && truth->outcome != domain::Outcome::kRunning;
  report.aborted = !robot.failure.empty()                   ? robot.failure
                   : !has_outcome && !fleet.aborted.empty() ? fleet.aborted
                                                            : std::string();
  if (!has_outcome) report.interrupted_by = fleet.interrupted_by;
  return report;
}

std::string outcome_of(const FleetReport& fleet) {
  if (!fleet.aborted.empty()) return "aborted";
  for (const RobotReport& robot : fleet.robots) {
    const std::string word = outcome_word(report_of(robot, fleet));
    if (word != "reached") return word;
  }
  return "reached";
}

/// That of the first robot that has not arrived.
int status_of(const FleetReport& fleet) {
  if (fleet.interrupted_by != 0) return kExitInterrupted;
  if (!fleet.aborted.empty()) return kExitFailed;
  for (const RobotReport& robot : fleet.robots) {
    const int status = exit_status(report_of(robot, fleet));
    if (status != kExitGood) return status;
  }
  return kExitGood;
}

ordered_json json_of(const RobotReport& robot, std::size_t index, const FleetReport& fleet) {
  const bridge::RunTruth truth = robot.statistics.truth.value_or(bridge::RunTruth{});
  ordered_json json = {{"name", robot.name},
                       {"robot_index", index},
                       {"outcome", outcome_word(report_of(robot, fleet))},
                       {"ticks", truth.tick},
                       {"sim_time_s", truth.sim_time_s},
                       {"path_length_m", truth.path_length_m},
                       {"safety_stops", truth.safety_stops},
                       {"traps", robot.statistics.traps_detected},
                       {"hash", robot.hash.hex()}};
  if (!robot.recording.empty()) json["recording"] = robot.recording;
  if (!robot.failure.empty()) json["failure"] = robot.failure;
  return json;
}

ordered_json json_of(const fleet::FleetPlan& plan, const FleetReport& report) {
  ordered_json robots = ordered_json::array();
  for (std::size_t i = 0; i < report.robots.size(); ++i) {
    robots.push_back(json_of(report.robots[i], i, report));
  }
  ordered_json json = {{"fleet", plan.file().name},
                       {"world", plan.robots().front().plan.graph.world},
                       {"outcome", outcome_of(report)}};
  if (!report.aborted.empty()) json["aborted"] = report.aborted;
  json["robots"] = std::move(robots);
  json["ticks"] = report.ticks;
  json["sim_time_s"] = report.sim_time_s;
  json["least_gap_m"] =
      std::isfinite(report.least_gap_m) ? ordered_json(report.least_gap_m) : ordered_json(nullptr);
  json["contacts"] = report.contacts;
  json["hash"] = report.hash.hex();
  json["wall_s"] = report.wall_s;
  return json;
}

void print_table(const FleetReport& report) {
  for (std::size_t i = 0; i < report.robots.size(); ++i) {
    const RobotReport& robot = report.robots[i];
    const bridge::RunTruth truth = robot.statistics.truth.value_or(bridge::RunTruth{});
    print_text("  {:>2} {:<16} {:<11} {:>6} ticks, {:>7.1f} s, path {:>6.2f} m, {} traps  {}\n", i,
               robot.name, outcome_word(report_of(robot, report)), truth.tick, truth.sim_time_s,
               truth.path_length_m, robot.statistics.traps_detected, robot.hash.hex());
  }
  const std::string gap = std::isfinite(report.least_gap_m)
                              ? fmt::format(", least gap {:.3f} m", report.least_gap_m)
                              : std::string();
  print_text("{}: {} robots, {} ticks{}, {} contacts, {:.1f} s, hash {}\n", outcome_of(report),
             report.robots.size(), report.ticks, gap, report.contacts, report.wall_s,
             report.hash.hex());
}

Result<fleet::FleetPlan> plan_of(const RunOptions& options, const core::Resource& file,
                                 const runtime::ConfigSource& source,
                                 const std::vector<runtime::StageInfo>& stages) {
  CLEW_RETURN_IF_ERROR(check_options(options));
  auto fleet_file = fleet::read_fleet_file(file, options.graph);
  if (!fleet_file.ok()) return fleet_file.error();
  return fleet::FleetPlan::prepare(std::move(fleet_file).value(),
                                   {options.overrides.seed, options.overrides.max_ticks}, source,
                                   stages);
}

}  // namespace

std::optional<core::Resource> fleet_of(const RunOptions& options) {
  if (options.graph.empty()) return std::nullopt;
  const auto files = runtime::ConfigPath::from_environment();
  auto file = files.find("graphs", options.graph);
  if (!file.ok()) file = files.find("fleets", options.graph);
  if (!file.ok() || !fleet::is_fleet(*file)) return std::nullopt;
  return std::move(file).value();
}

int run_fleet_command(const RunOptions& options, const core::Resource& file,
                      bridge::EndSignals& signals) {
  if (!options.resume.empty()) {
    return complain(
        {"is of a single robot, and this is a fleet; allowed: one of both", "--resume"});
  }
  if (const auto loaded = load_plugins_of(options.plugins); !loaded.ok()) {
    return complain(loaded.error());
  }
  const auto source = runtime::ConfigPath::from_environment();
  const auto stages = stages::all();
  const auto plan = plan_of(options, file, source, stages);
  if (!plan.ok()) return complain(plan.error());
  fleet::FleetOptions run;
  if (options.layout == "processes") {
    const auto layouts = layouts_of(options, *plan);
    if (!layouts.ok()) return complain(layouts.error());
    run.again = [&options, &signals, layouts = *layouts](const auto& robots) {
      return run_robots_as_processes(robots, layouts, options.force,
                                     [&signals] { return signals.take(); });
    };
  }
  run.threads = static_cast<unsigned>(options.threads.value_or(1));
  run.record = options.record;
  run.force = options.force;
  run.interrupted = [&signals] { return signals.take(); };
  if (shows_progress()) {
    run.display = [&](std::uint64_t tick, std::size_t ended) {
      fmt::print(stderr, "\r\033[Ktick {}, {} of {} robots have ended", tick, ended,
                 plan->robots().size());
    };
  }
  const auto report = fleet::run_fleet(*plan, run);
  if (run.display) std::fputs("\r\033[K", stderr);
  if (!report.ok()) return complain(report.error());
  if (!report->aborted.empty()) logs::error("{}", report->aborted);
  if (options.json) {
    fmt::print("{}\n", json_line(json_of(*plan, *report)));
  } else {
    print_table(*report);
  }
  return status_of(*report);
}

}  // namespace clew::tools
