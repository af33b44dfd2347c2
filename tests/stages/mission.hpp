// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/run_plan.hpp"

namespace clew::stages {

/// How a run went.
struct Report {
  domain::Outcome outcome = domain::Outcome::kRunning;
  std::uint64_t ticks = 0;
  double path_length_m = 0.0;
  std::uint32_t collisions = 0;
  std::uint32_t safety_stops = 0;
  int traps = 0;
  int reflexes = 0;
};

/// A run of a shipped graph in one thread, which can be stopped, saved and taken up.
class Mission {
 public:
  /// The state between two ticks.
  struct Saved {
    std::vector<std::string> nodes;
    domain::Messages messages;
    std::uint64_t next_tick = 0;
  };

  /// `graph` in `world`; `with` and `set` as on the command line.
  Mission(const std::string& graph, const std::string& world,
          const std::vector<std::string>& with = {}, const std::vector<std::string>& set = {});

  /// One tick of all stages.
  void step();
  /// Whether the last tick was the run's last.
  bool over() const;
  /// Steps to the end of the run.
  Report run();

  Saved save() const;
  void load(const Saved& saved);

  /// A hash of all samples of the last tick.
  std::string digest() const;

 private:
  void count_events();

  runtime::RunPlan plan_;
  std::vector<runtime::Node> nodes_;
  domain::Messages messages_;
  std::uint64_t next_tick_ = 0;
  Report report_;
};

/// The shipped worlds in which nothing moves, by name.
std::vector<std::string> static_worlds();

/// Whether a world says that its target can be reached.
bool is_solvable(const std::string& world);

}  // namespace clew::stages
