// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "component/input_history.hpp"
#include "line/acceptor.hpp"
#include "line/command_desk.hpp"
#include "line/domain_lock.hpp"
#include "run/composed_run.hpp"
#include "run/run_control.hpp"

namespace clew::bridge {

/// What people and programs do to a composed run while it goes on, if it has a name by which they
/// find it; and what was planned for it.
class ComposedControl : public ComposedOrders {
 public:
  /// Without a name it takes no commands. Both must outlive it.
  ComposedControl(RunControl& control, const RunName* name);

  void serve(std::uint64_t next_tick, std::vector<runtime::NodeSuccession>& nodes,
             SampleSink* recording, std::chrono::milliseconds patience) override;
  void note(std::uint64_t tick, const std::vector<runtime::NodeSuccession>& nodes,
            const domain::Messages& messages) override;
  bool may_begin(std::uint64_t tick) const override { return !held_from_ || tick < *held_from_; }
  std::string stopped() const override { return stopped_; }
  std::optional<double> take_pace() override { return std::exchange(pace_factor_, std::nullopt); }
  RunProfile* profile() override { return profile_ ? &*profile_ : nullptr; }

 private:
  std::optional<CommandAnswer> decide(RunCommand& command, std::uint64_t next_tick,
                                      std::vector<runtime::NodeSuccession>& nodes);
  /// Steps are timed from the first question on, and told since the question before.
  CommandAnswer status(std::uint64_t next_tick, const std::vector<runtime::NodeSuccession>& nodes);
  std::optional<CommandAnswer> view(std::uint64_t next_tick);
  CommandAnswer change(const RunCommand& command, std::uint64_t next_tick,
                       std::vector<runtime::NodeSuccession>& nodes);
  CommandAnswer step(RunCommand& command, std::uint64_t next_tick);
  core::Result<void> feed(runtime::NodeSuccession& node, runtime::Successor successor,
                          std::uint64_t next_tick);
  void record(const domain::Intervention& intervention) { to_record_.push_back(intervention); }

  RunControl& control_;
  std::optional<Acceptor> acceptor_;
  CommandDesk desk_;
  std::map<std::string, InputHistory> histories_;  ///< by stage
  std::optional<std::uint64_t> held_from_;
  std::string stopped_;
  std::optional<double> pace_factor_;
  std::optional<RunProfile> profile_;
  std::vector<domain::Intervention> to_record_;
};

}  // namespace clew::bridge
