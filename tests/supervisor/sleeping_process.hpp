// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

#include "supervisor/child_process.hpp"

namespace clew::bridge {

/// A process that only waits, in the place of any program.
inline core::Result<ChildProcess> start_sleeping(const ChildCommand&) {
  ChildCommand command;
  command.arguments = {"sleep", "60"};
  return ChildProcess::start(command);
}

/// Ends it, and waits until it has ended.
inline void end_now(ChildProcess& process, int number = SIGKILL) {
  process.signal(number);
  while (process.running()) process.reap();
}

}  // namespace clew::bridge
