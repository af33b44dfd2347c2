// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/run_plan.hpp"

namespace clew::stages {

/// The names of the graphs in configs/.
std::vector<std::string> shipped_graphs();

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

  /// Why the same would not be run; empty if it would.
  static std::string refusal(const std::string& graph, const std::string& world,
                             const std::vector<std::string>& with);

  /// One tick of all stages.
  void step();
  /// Whether the last tick was the run's last.
  bool over() const;
  /// The truth at the start of the last tick.
  const domain::State& state() const { return std::get<domain::State>(messages_); }

  /// All samples of the last tick.
  const domain::Messages& messages() const { return messages_; }

  Saved save() const;
  void load(const Saved& saved);

  /// A hash of all samples of the last tick.
  std::string digest() const;
  /// A hash of one topic's sample of the last tick.
  std::string digest_of(domain::Topic topic) const;

 private:
  runtime::RunPlan plan_;
  std::vector<runtime::Node> nodes_;
  domain::Messages messages_;
  std::uint64_t next_tick_ = 0;
};

}  // namespace clew::stages
