// SPDX-License-Identifier: Apache-2.0
#include "run/run_statistics.hpp"

#include "core/geometry.hpp"

namespace clew::bridge {
namespace {

bool has_left(const Standstill& spot, const domain::State& state) {
  const core::Vec2 moved(state.pose_world_robot.x_m - spot.x_m,
                         state.pose_world_robot.y_m - spot.y_m);
  return core::length(moved) > Standstill::kSpot_m;
}

Standstill standstill_at(const domain::State& state) {
  return {state.stamp.tick,           state.stamp.sim_time_s, state.pose_world_robot.x_m,
          state.pose_world_robot.y_m, state.collisions,       state.safety_stops};
}

}  // namespace

void RunStatistics::add(const domain::State& state) {
  const bool stands = truth && !has_left(truth->standstill, state);
  const std::uint32_t late_before = truth ? truth->late_commands : 0;
  const Standstill standstill = stands ? truth->standstill : standstill_at(state);
  truth = RunTruth{state.stamp.tick,
                   state.outcome,
                   state.stamp.sim_time_s,
                   state.path_length_m,
                   state.pose_world_robot.x_m,
                   state.pose_world_robot.y_m,
                   state.collisions,
                   state.hit_by,
                   state.safety_stops,
                   late_before + (state.command_late ? 1 : 0),
                   standstill,
                   state.speed_mps,
                   state.turn_rate_radps};
}

void RunStatistics::add(const domain::Guidance& guidance) {
  mode = guidance.mode;
  why = guidance.why;
}

void RunStatistics::add(const domain::Event& event) {
  for (const domain::EventEntry& entry : event.entries) {
    if (entry.kind == domain::EventKind::kTrap) add_alarm(entry);
    if (entry.shadow) continue;
    if (entry.kind == domain::EventKind::kTrap) ++traps_detected;
    if (entry.kind == domain::EventKind::kVirtualTarget) ++virtual_targets;
  }
}

void RunStatistics::add_alarm(const domain::EventEntry& entry) {
  if (alarms.size() >= kMostRules && alarms.count(entry.rule) == 0) return;
  RuleAlarms& of_rule = alarms[entry.rule];
  ++(entry.shadow ? of_rule.in_shadow : of_rule.in_command);
}

void RunStatistics::merge(const RunStatistics& other) {
  if (other.truth) truth = other.truth;
  if (other.mode) {
    mode = other.mode;
    why = other.why;
  }
  traps_detected += other.traps_detected;
  virtual_targets += other.virtual_targets;
  for (const auto& [rule, count] : other.alarms) {
    alarms[rule].in_command += count.in_command;
    alarms[rule].in_shadow += count.in_shadow;
  }
}

}  // namespace clew::bridge
