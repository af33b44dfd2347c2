// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "runtime/stage.hpp"

namespace clew::bridge {

/// Runs one stage as a process of its own: takes its assignment from the run that holds `domain`,
/// meets the other components on the wire, and steps until the run is over. `connect_timeout_s`
/// says how long to wait for the run. Returns the exit status: 0 when the run ended as it should,
/// 1 otherwise; what went wrong is on stderr.
int run_component_process(const std::string& stage, int domain, double connect_timeout_s,
                          const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::bridge
