// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "line/command_desk.hpp"
#include "run/run_control.hpp"
#include "supervisor/member.hpp"

namespace clew::bridge {

/// What people and programs do to a run of processes while it goes on. A change is told to every
/// component before the first tick that it holds for may begin; a hold is told to the stage that
/// starts ticks.
class LiveControl {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// How the run stands.
  struct Situation {
    bool gone = false;                  ///< it has begun
    bool ending = false;                ///< its last tick is known
    std::uint64_t first_open_tick = 0;  ///< no component has begun this tick, nor will soon
    std::uint64_t ticks = 0;            ///< that were started
  };

  /// `control` may be null: then the run takes no commands. Arguments must outlive it.
  LiveControl(RunControl* control, std::vector<Member>& members, bool realtime);

  void welcome(std::unique_ptr<Link> link, Time now) { desk_.welcome(std::move(link), now); }
  std::vector<pollfd> descriptors() const { return desk_.descriptors(); }
  /// Answers what has arrived.
  void serve(const Situation& situation, Time now);

  /// What a component that joins is told with its assignment, and after it.
  void fill(Assignment& assignment) const;
  void join(Member& member);
  /// Notes what a frame of `stage` says of a hold or a change.
  void note(const std::string& stage, const Frame& frame);

  /// In real time: brings the robot to rest, where it stays until somebody says `resume`.
  void disarm();
  /// In real time: the robot goes half as fast, or as fast as before.
  void slow(bool slowly);
  /// Ticks below this one may be started: beyond it not everybody knows yet what changes.
  std::uint64_t credit() const;
  /// Whether no tick is to be expected.
  bool holds() const { return held_from_.has_value(); }
  /// PaceChange::factor, if somebody has changed the pace.
  std::optional<double> pace_factor() const { return pace_factor_; }
  /// Why the run is to end; empty if it is not.
  const std::string& stopped() const { return stopped_; }
  /// What is to be recorded since the last call.
  std::vector<domain::Intervention> take_interventions();
  bool goal_changed_by(std::uint64_t tick) const {
    return control_ != nullptr && control_->goal_changed_by(tick);
  }

 private:
  std::optional<CommandAnswer> decide(RunCommand& command, const Situation& situation, Time now);
  CommandAnswer status(const Situation& situation, Time now) const;
  std::optional<CommandAnswer> view(const Situation& situation) const;
  CommandAnswer change(const RunCommand& command, const Situation& situation);
  std::optional<CommandAnswer> pause(const Situation& situation);
  std::optional<CommandAnswer> step(RunCommand& command, const Situation& situation);
  CommandAnswer resume(const Situation& situation);
  CommandAnswer pace(const RunCommand& command, const Situation& situation);
  /// The stage knows of the change at `tick`, or of all.
  void forget(const std::string& stage, std::optional<std::uint64_t> tick = std::nullopt);
  template <typename Message>
  void tell_starter(FrameType type, const Message& message) const;

  RunControl* const control_;
  std::vector<Member>& members_;
  const bool realtime_;
  CommandDesk desk_;
  std::optional<std::uint64_t> held_from_;  ///< 0: not known yet, but asked for
  bool hold_confirmed_ = false;
  bool disarmed_ = false;
  std::optional<double> pace_factor_;
  std::string stopped_;
  std::map<std::uint64_t, std::set<std::string>>
      not_noted_;  ///< by tick: stages that have not said
  std::vector<domain::Intervention> to_record_;
  std::vector<domain::Intervention> unconfirmed_;  ///< in real time: not in force yet
};

}  // namespace clew::bridge
