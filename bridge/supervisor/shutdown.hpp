// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <vector>

#include "supervisor/member.hpp"

namespace clew::bridge {

/// Closes every line, which tells our components that the run is over, and waits for all processes
/// to end: asked by a signal if they are not ours or the run was cut off, killed if they stay.
void end_processes(std::vector<Member>& members, bool orderly);

}  // namespace clew::bridge
