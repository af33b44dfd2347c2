// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/run_plan.hpp"

namespace clew::contract {

/// A run in one thread, which can be stopped, saved and taken up.
class Mission {
 public:
  /// The state between two ticks.
  struct Saved {
    std::vector<std::string> nodes;
    domain::Messages messages;
    std::uint64_t next_tick = 0;
  };
  /// Changes what sense has measured before anybody reads it.
  using Disturb = std::function<void(domain::Scan&)>;

  /// `graph` in `world`; `with` and `set` as on the command line. Refused: what `clew run` refuses.
  static core::Result<Mission> create(const runtime::ConfigSource& configs,
                                      const std::string& graph, const std::string& world,
                                      const std::vector<std::string>& with,
                                      const std::vector<std::string>& set);
  /// The same of a plan that is read already.
  static core::Result<Mission> create(runtime::RunPlan plan);

  /// Takes what a stage tells of its inside.
  using Listen = std::function<void(const std::string& stage, const domain::Inside& inside)>;

  /// One tick of all stages; each is asked for its inside if somebody listens.
  void step(const Disturb& disturb = nullptr, const Listen& listen = nullptr);
  /// Whether the last tick was the run's last.
  bool over() const;
  /// The truth at the start of the last tick.
  const domain::State& state() const { return std::get<domain::State>(messages_); }

  /// All samples of the last tick.
  const domain::Messages& messages() const { return messages_; }
  std::uint64_t next_tick() const { return next_tick_; }
  /// The topics that this run has.
  const runtime::TopicSet& topics() const { return topics_; }

  Saved save() const;
  core::Result<void> load(const Saved& saved);

  /// A hash of all samples of the last tick.
  std::string digest() const;
  /// A hash of one topic's sample of the last tick.
  std::string digest_of(domain::Topic topic) const;

 private:
  Mission(runtime::RunPlan plan, std::vector<runtime::Node> nodes);

  runtime::RunPlan plan_;
  std::vector<runtime::Node> nodes_;
  runtime::TopicSet topics_;
  domain::Messages messages_;
  std::uint64_t next_tick_ = 0;
};

}  // namespace clew::contract
