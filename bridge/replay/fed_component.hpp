// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "line/run_key.hpp"
#include "replay/live_comparison.hpp"
#include "run/limits.hpp"
#include "runtime/run_plan.hpp"
#include "supervisor/member.hpp"
#include "vendors/third_party_environment.hpp"

namespace clew::bridge {

/// How a replay is on the wire.
struct WireSettings {
  std::string run_id;
  std::string program;     ///< the clew command
  std::string middleware;  ///< of a component whose graph does not say
  int domain = 0;
  double lease_s = kLease_s;
  int history_depth = kHistoryDepth;
  std::vector<domain::Intervention> interventions = {};  ///< that the recorded run had
  RunKey run_key = {};
};

/// A component process on the wire that is fed from a recording: to the component it is a run, on
/// whose domain it finds a line, an assignment and the writers and readers of the others.
class FedComponent {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `log` takes lines for people. The plan must outlive the component.
  FedComponent(const runtime::RunPlan& plan, const runtime::GraphStage& stage,
               WireSettings settings, std::uint64_t first_compared,
               std::function<void()> on_arrival, std::function<void(const std::string&)> log);

  const std::string& stage() const { return member_.stage; }
  const runtime::NodePorts& ports() const { return stage_.ports; }

  /// Creates the readers of what it writes. Both arguments must outlive the component.
  core::Result<void> open(Participant& participant, StartBarrier& barrier);
  /// Starts its process, or says how to.
  core::Result<void> start(bool by_us, const std::string& prefix);
  /// Takes up the line of a process that says that it is the component. Refused: a second one, one
  /// of another stage, and one that was built from other IDL files.
  core::Result<void> welcome(std::unique_ptr<Link>& link, const Hello& hello);

  int socket() const { return member_.link ? member_.link->socket() : -1; }
  bool ready() const { return member_.third_party || member_.ready; }
  /// What it waits for, a sentence each.
  std::vector<std::string> missing() const;

  /// Takes in what it says, and compares what it wrote. An error is its end.
  core::Result<void> serve(Time now);
  /// Lets drive begin with tick 0; the others begin with their inputs.
  void go();
  /// It is about to be fed a tick. Refused: one that is not the next, or lacks an input.
  core::Result<void> feed(const RecordedTick& recorded);
  /// Ticks fed whose outputs are not all here.
  std::size_t outstanding() const { return comparison_.outstanding(); }
  std::uint64_t next_compared() const { return comparison_.next_tick(); }
  const ReplayReport& report() const { return comparison_.report(); }

  /// The tick fed last is the run's last one; it may leave.
  void finish();
  bool finished() const { return member_.third_party || member_.finished.has_value(); }
  /// Ends the process if it is ours.
  void end(bool orderly);

 private:
  Assignment assignment() const;
  core::Result<void> handle(const Frame& frame, Time now);
  core::Error lost() const;

  const runtime::RunPlan& plan_;
  const runtime::GraphStage& stage_;
  const WireSettings settings_;
  const ThirdPartyEnvironment environment_;
  const std::function<void(const std::string&)> log_;
  Member member_;
  LiveComparison comparison_;
  std::uint64_t next_tick_ = 0;
};

}  // namespace clew::bridge
