// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "supervisor/group_guard.hpp"

namespace clew::bridge {

/// A program to start.
struct ChildCommand {
  std::vector<std::string> arguments;              ///< the program first, looked up in PATH
  std::map<std::string, std::string> environment;  ///< on top of ours
  bool keeps_terminal = false;  ///< for a debugger; else no input, and output goes to stderr
  bool brings_to_rest = false;  ///< is sent SIGTERM, not SIGKILL, when we die
  int inherited = -1;  ///< a descriptor of ours that it has under the same number; -1: none
  bool may_start_others =
      false;  ///< a program that we know nothing of: what it starts ends with it
};

/// A program that we started and that does not outlive us, however we end.
class ChildProcess {
 public:
  /// Starts it; the error says why it cannot be.
  static core::Result<ChildProcess> start(const ChildCommand& command);

  int process_id() const { return process_id_; }
  bool running() const { return running_; }
  /// Takes note of its end, without waiting. True when it has just ended.
  bool reap();
  /// `was killed by signal 11 (Segmentation fault)`, `exited with status 3`; once it has ended.
  std::string end() const;
  /// Whether SIGKILL ended it, which no program does to itself.
  bool was_killed() const;
  /// Sends a signal to it and to the processes that it started, while it runs.
  void signal(int number) const;
  /// As waitpid(2) gives it, once it has ended.
  int status() const { return status_; }

 private:
  ChildProcess(int process_id, bool own_group, std::optional<GroupGuard> guard)
      : process_id_(process_id), own_group_(own_group), guard_(std::move(guard)) {}

  int process_id_;
  bool own_group_;
  std::optional<GroupGuard> guard_;
  bool running_ = true;
  int status_ = 0;
};

}  // namespace clew::bridge
