// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew::bridge {

inline constexpr char kFallbackHere[] = "local";

/// What a relay is to do.
struct RelayOrder {
  std::string hosts_file;
  std::string host;
  std::string stage;  ///< or group
  int domain = 0;     ///< of the run, which is here
  /// A host that does not answer is not waited for for long: the component runs on this one
  /// instead, or here, as this process, if it is kFallbackHere. Empty: it is waited for.
  std::string fallback;
  std::string program;  ///< the clew command
  std::string version;
};

/// Has a host start a component, and is to the run, as this process, what the component would be:
/// it passes on what either says, and ends as the component ends. A host that is lost ends it, too,
/// by SIGKILL, so that the run starts it again as after any kill that came from outside. Returns
/// the exit status.
int run_relay(const RelayOrder& order);

}  // namespace clew::bridge
