// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "fleet/fleet_run.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::tools {

/// Runs robots, each by itself as one process a stage, joined by DDS in a domain of its own; all at
/// once. `layouts` are theirs, in their order; `force` says whether recordings may be overwritten.
/// `interrupted` is asked now and then for the signal that is to end them, or 0.
fleet::AloneResults run_robots_as_processes(const std::vector<fleet::RobotAlone>& robots,
                                            const std::vector<bridge::ProcessLayout>& layouts,
                                            bool force, const std::function<int()>& interrupted);

}  // namespace clew::tools
