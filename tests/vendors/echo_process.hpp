// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include "vendors/participant_factory.hpp"

namespace clew::bridge {

/// How many samples the echo's histories hold: four times as many as come between two
/// acknowledgements, 20 ms, at the shortest way that was measured, so that its writer does not wait
/// for one.
inline constexpr int kEchoDepth = 2048;

/// The program of echo_component.cpp as a child process, which lasts until this is destroyed.
class EchoProcess {
 public:
  /// `core`: the processor that it may use; -1 for any.
  EchoProcess(Vendor vendor, int domain, int core = -1);
  ~EchoProcess() { end(); }
  EchoProcess(const EchoProcess&) = delete;
  EchoProcess& operator=(const EchoProcess&) = delete;

  pid_t pid() const { return pid_; }
  void kill_it();
  /// The status that waitpid gives, once the process has been told to end.
  int end();

 private:
  pid_t pid_ = -1;
  int stdin_ = -1;
  int status_ = 0;
};

}  // namespace clew::bridge
