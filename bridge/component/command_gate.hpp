// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::bridge {

/// Stands before the stage that moves the robot, in real time: lets all commands pass, every second
/// one, or none. A command that does not pass is to the stage one that is late, in whose tick the
/// robot rests, and its `state` says so. So what the gate did is in the recording, and a replay
/// needs to know nothing of it.
class CommandGate {
 public:
  /// All may pass again.
  void open() {
    shut_ = false;
    halves_ = false;
  }
  /// Of the commands that come, every second one may pass; or all of them again.
  void halve(bool halves) {
    halves_ = halves;
    passed_ = false;
  }
  /// None may pass, until open().
  void shut() { shut_ = true; }
  bool is_shut() const { return shut_; }
  /// Whether the next command may pass.
  bool lets_pass() {
    if (shut_) return false;
    passed_ = !halves_ || !passed_;
    return passed_;
  }

 private:
  bool shut_ = false;
  bool halves_ = false;
  bool passed_ = false;  ///< the last one, while it halves
};

}  // namespace clew::bridge
