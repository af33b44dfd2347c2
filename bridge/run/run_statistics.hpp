// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "domain/topics.hpp"

namespace clew::bridge {

/// Since when the robot has stood on one spot, turning or not.
struct Standstill {
  static constexpr double kSpot_m = 0.05;  ///< radius of the spot

  std::uint64_t since_tick = 0;
  double since_s = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  std::uint32_t collisions = 0;  ///< of the run, when it began
  std::uint32_t safety_stops = 0;
};

/// What the simulation's own account of a run was last.
struct RunTruth {
  std::uint64_t tick = 0;
  domain::Outcome outcome = domain::Outcome::kRunning;
  double sim_time_s = 0.0;
  double path_length_m = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  std::uint32_t collisions = 0;
  std::uint32_t hit_by = 0;
  std::uint32_t safety_stops = 0;
  std::uint32_t late_commands = 0;
  Standstill standstill;
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;

  bool at_rest() const { return speed_mps == 0.0 && turn_rate_radps == 0.0; }
};

/// How often a rule said *trap*.
struct RuleAlarms {
  std::uint32_t in_command = 0;
  std::uint32_t in_shadow = 0;
};

/// What is counted and shown of a run, gathered from the samples of whichever topics pass by.
/// Tallies of several processes add up to the whole.
struct RunStatistics {
  static constexpr std::size_t kMostRules = 64;  ///< a third-party component may say anything

  std::optional<RunTruth> truth;             ///< from `state`
  std::optional<domain::GuidanceMode> mode;  ///< from `guidance`
  std::string why;                           ///< what `guidance` says of itself
  std::uint32_t traps_detected = 0;          ///< from `event`, shadows left out
  std::uint32_t virtual_targets = 0;         ///< from `event`
  std::map<std::string, RuleAlarms> alarms;  ///< by rule, from `event`; the first kMostRules

  void add(const domain::State& state);
  void add(const domain::Guidance& guidance);
  void add(const domain::Event& event);
  /// Other topics say nothing that is counted.
  template <typename Message>
  void add(const Message&) {}

  /// Takes over what another process, which saw other topics, has gathered.
  void merge(const RunStatistics& other);

 private:
  void add_alarm(const domain::EventEntry& entry);
};

template <typename V>
void visit_fields(V& v, Standstill& s) {
  v(s.since_tick, s.since_s, s.x_m, s.y_m, s.collisions, s.safety_stops);
}
template <typename V>
void visit_fields(V& v, RunTruth& t) {
  v(t.tick, t.outcome, t.sim_time_s, t.path_length_m, t.x_m, t.y_m, t.collisions, t.hit_by,
    t.safety_stops, t.late_commands, t.standstill, t.speed_mps, t.turn_rate_radps);
}
template <typename V>
void visit_fields(V& v, RuleAlarms& a) {
  v(a.in_command, a.in_shadow);
}
template <typename V>
void visit_fields(V& v, RunStatistics& t) {
  v(t.truth, t.mode, t.why, t.traps_detected, t.virtual_targets, t.alarms);
}

}  // namespace clew::bridge
