// SPDX-License-Identifier: Apache-2.0
#include "clew/run_output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/seed_note.hpp"
#include "clew/terminal.hpp"
#include "core/terminal_text.hpp"
#include "world/world.hpp"

namespace clew::tools {
namespace {

using bridge::RunReport;
using bridge::RunStatistics;
using bridge::RunTruth;
using domain::Outcome;

const char* mode_word(const RunStatistics& statistics) {
  if (!statistics.mode) return "seek";
  switch (*statistics.mode) {
    case domain::GuidanceMode::kSeek:
      return "seek";
    case domain::GuidanceMode::kRecover:
      return "recover";
    case domain::GuidanceMode::kUnreachable:
      return "unreachable";
  }
  return "seek";
}

RunTruth truth_of(const RunReport& report) { return report.statistics.truth.value_or(RunTruth{}); }

/// `1 trap`, `2 traps`.
std::string count_text(std::uint64_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// Who said *trap* how often: ` (landmark_revisit 2; in shadow: oscillation 1)`; empty if nobody.
std::string alarms_text(const RunStatistics& statistics) {
  std::string in_command;
  std::string in_shadow;
  const auto add = [](std::string& text, const std::string& rule, std::uint32_t count) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", rule, count);
  };
  for (const auto& [rule, alarms] : statistics.alarms) {
    add(in_command, rule, alarms.in_command);
    add(in_shadow, rule, alarms.in_shadow);
  }
  if (!in_shadow.empty()) {
    in_command += (in_command.empty() ? "" : "; ") + ("in shadow: " + in_shadow);
  }
  return in_command.empty() ? "" : " (" + in_command + ')';
}

/// None is known of the way to a goal that came later.
std::optional<double> shortest_path_m(const RunReport& report, const runtime::RunPlan& plan) {
  return report.goal_changed ? std::nullopt : plan.setup.world->shortest_path_m();
}

}  // namespace

std::string outcome_word(const RunReport& report) {
  if (!report.aborted.empty()) return "aborted";
  switch (truth_of(report).outcome) {
    case Outcome::kReached:
      return "reached";
    case Outcome::kCollided:
      return "collided";
    case Outcome::kUnreachable:
      return "unreachable";
    case Outcome::kTimeout:
      return "timeout";
    case Outcome::kRunning:
      break;
  }
  return "aborted";
}

int exit_status(const RunReport& report) {
  if (report.interrupted_by != 0) return kExitInterrupted;
  if (!report.aborted.empty()) return kExitFailed;
  switch (truth_of(report).outcome) {
    case Outcome::kReached:
      return kExitGood;
    case Outcome::kCollided:
      return kExitCollided;
    case Outcome::kUnreachable:
      return kExitUnreachable;
    case Outcome::kTimeout:
      return kExitTimeout;
    case Outcome::kRunning:
      break;
  }
  return kExitFailed;
}

namespace {

constexpr double kLongStand_s = 60.0;

bool stood_long(const RunTruth& truth) {
  const bool arrived = truth.outcome == Outcome::kReached;
  return !arrived && truth.sim_time_s - truth.standstill.since_s >= kLongStand_s;
}

/// What kept a robot that stands where it is, as far as the run tells.
std::string reason_of_standstill(const RunReport& report, const RunTruth& truth) {
  const auto& statistics = report.statistics;
  const std::uint32_t stops = truth.safety_stops - truth.standstill.safety_stops;
  if (stops > 0) return "the safety layer has stopped it " + count_text(stops, "time") + " since";
  if (truth.collisions > truth.standstill.collisions) return "it pushes against an obstacle";
  std::string reason = "its controller leads nowhere, and ";
  if (!statistics.mode) return reason + "the graph has no recover";
  if (*statistics.mode == domain::GuidanceMode::kSeek) {
    reason += "recovery notices no trap";
  } else {
    reason = fmt::format("{} leads nowhere", mode_word(statistics));
  }
  return statistics.why.empty() ? reason : reason + ": " + statistics.why;
}

std::string standstill_note(const RunReport& report, const RunTruth& truth) {
  return fmt::format(
      "the robot has stood on one spot, ({:.2f}, {:.2f}), since tick {} ({:.1f} s), "
      "for {:.0f} s: {}",
      truth.standstill.x_m, truth.standstill.y_m, truth.standstill.since_tick,
      truth.standstill.since_s, truth.sim_time_s - truth.standstill.since_s,
      reason_of_standstill(report, truth));
}

/// The parameters that make odometry err: `drive.drift_rad_per_sqrt_m 0.03`; empty without any.
std::string drift_text(const runtime::Graph& graph) {
  const runtime::GraphStage* drive = graph.find("drive");
  if (drive == nullptr) return {};
  std::string text;
  for (const auto& [name, value] : drive->config.parameters) {
    const double* number = std::get_if<double>(&value);
    if (name.compare(0, 6, "drift_") != 0 || number == nullptr || *number == 0.0) continue;
    text += fmt::format("{}drive.{} {}", text.empty() ? "" : ", ", name, *number);
  }
  return text;
}

std::string outcome_in_colour(const RunReport& report) {
  const std::string word = outcome_word(report);
  const bool ended = report.aborted.empty();
  const Outcome outcome = truth_of(report).outcome;
  if (ended && outcome == Outcome::kReached) return in_colour(word, Tone::kGood);
  const bool undecided =
      ended && (outcome == Outcome::kTimeout || outcome == Outcome::kUnreachable);
  return in_colour(word, undecided ? Tone::kDoubtful : Tone::kBad);
}

}  // namespace

std::vector<std::string> notes_on(const RunReport& report, const runtime::RunPlan& plan,
                                  const RunFacts& facts) {
  std::vector<std::string> notes;
  const RunTruth truth = truth_of(report);
  if (stood_long(truth)) notes.push_back(standstill_note(report, truth));
  const std::string drift = drift_text(plan.graph);
  if (truth.outcome == Outcome::kUnreachable && !drift.empty()) {
    notes.push_back("odometry may be the reason for 'unreachable': it errs (" + drift +
                    "), and the proof holds in its frame");
  }
  if (facts.seed_given && !goes_by_chance(plan.graph)) notes.push_back(seed_note(plan.graph));
  for (const std::uint64_t tick : facts.planned_changes) {
    if (tick <= truth.tick) continue;
    notes.push_back(fmt::format(
        "the change at tick {} did not come to pass: the run ended at tick {}", tick, truth.tick));
  }
  return notes;
}

std::string report_json(const RunReport& report, const runtime::RunPlan& plan,
                        const RunFacts& facts) {
  const RunTruth truth = truth_of(report);
  const auto shortest_m = shortest_path_m(report, plan);
  nlohmann::ordered_json json;
  json["outcome"] = outcome_word(report);
  json["graph"] = plan.graph.name;
  json["world"] = plan.graph.world;
  json["ticks"] = truth.tick;
  json["sim_time_s"] = truth.sim_time_s;
  json["path_length_m"] = truth.path_length_m;
  json["shortest_path_m"] = shortest_m ? nlohmann::ordered_json(*shortest_m) : nullptr;
  json["traps_detected"] = report.statistics.traps_detected;
  json["virtual_targets"] = report.statistics.virtual_targets;
  json["collisions"] = truth.collisions;
  json["hit_by"] = truth.hit_by;
  json["safety_stops"] = truth.safety_stops;
  json["late_commands"] = truth.late_commands;
  json["still_since"] = nullptr;
  if (stood_long(truth)) {
    json["still_since"] = {{"tick", truth.standstill.since_tick},
                           {"time_s", truth.standstill.since_s},
                           {"x_m", truth.standstill.x_m},
                           {"y_m", truth.standstill.y_m}};
  }
  json["notes"] = notes_on(report, plan, facts);
  json["restarts"] = report.restarts;
  json["start_s"] = report.start_s ? nlohmann::ordered_json(*report.start_s) : nullptr;
  json["wall_s"] = report.wall_s;
  json["ticks_per_s"] = report.ticks_per_s;
  json["layout"] = facts.layout;
  json["middleware"] = facts.middleware;
  json["secured"] = report.secured;
  json["seed"] = plan.graph.seed;
  json["hash"] = report.hash ? nlohmann::ordered_json(report.hash->hex()) : nullptr;
  json["recording"] = facts.recording.empty() ? nullptr : nlohmann::ordered_json(facts.recording);
  if (report.recording) json["lost_samples"] = report.recording->lost_samples;
  json["refused_samples"] = report.refused_samples;
  json["why"] = report.aborted;
  if (facts.branch_tick) json["branch_tick"] = *facts.branch_tick;
  return json_line(json);
}

std::string report_line(const RunReport& report, const runtime::RunPlan& plan) {
  const RunTruth truth = truth_of(report);
  const auto shortest_m = shortest_path_m(report, plan);
  const std::string world = core::terminal_text(plan.graph.world);
  std::string line =
      fmt::format("{} in {}: {} ticks ({:.1f} s), path {:.2f} m", outcome_in_colour(report), world,
                  truth.tick, truth.sim_time_s, truth.path_length_m);
  const bool has_outcome = report.aborted.empty() && truth.outcome != Outcome::kRunning;
  if (!has_outcome && truth.tick == 0) {
    line =
        fmt::format("{} in {}: before the first tick had ended", outcome_in_colour(report), world);
  } else if (!has_outcome) {
    line += fmt::format(", at ({:.2f}, {:.2f})", truth.x_m, truth.y_m);
  }
  if (has_outcome && shortest_m)
    line += fmt::format(" ({:.2f} x shortest)", truth.path_length_m / *shortest_m);
  line +=
      ", " + count_text(report.statistics.traps_detected, "trap") + alarms_text(report.statistics);
  line += ", " + count_text(truth.collisions, "collision") + ", " +
          count_text(truth.safety_stops, "safety stop");
  if (truth.hit_by > 0) {
    line += ", " + count_text(truth.hit_by, "contact") + " by moving obstacles";
  }
  line += fmt::format(", {:.0f} ticks/s", report.ticks_per_s);
  if (report.hash) line += ", hash " + report.hash->hex();
  return line;
}

bridge::ProgressDisplay terminal_display(const runtime::RunPlan& plan) {
  if (!shows_progress()) return {};
  const core::Vec2 target = plan.setup.world->target();
  return [target](const RunStatistics& statistics, double ticks_per_s) {
    if (!statistics.truth) return;
    const double distance_m =
        core::length(target - core::Vec2(statistics.truth->x_m, statistics.truth->y_m));
    std::fprintf(stderr, "\r\033[Ktick %llu  distance %.2f m  %s  %.0f ticks/s",
                 static_cast<unsigned long long>(statistics.truth->tick), distance_m,
                 mode_word(statistics), ticks_per_s);
  };
}

void clear_display() {
  if (shows_progress()) std::fputs("\r\033[K", stderr);
}

}  // namespace clew::tools
