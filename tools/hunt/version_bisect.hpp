// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "hunt/bisect_search.hpp"
#include "runtime/run_plan.hpp"

namespace clew::hunt {

/// Two builds of the clew command, as paths. The first one supervises and records every run.
struct TwoVersions {
  std::string own;
  std::string other;
};

/// Which component of another version matters: see search_bisect. `plan` is run as processes; run A
/// has all components by our own version, run B all by the other, and the differences are the
/// stages.
///
/// Refused: an other version that cannot be started or has other messages (all its runs are
/// aborted), stages that share a process, and stages of somebody else's.
core::Result<BisectEnd> bisect_versions(const runtime::RunPlan& plan, const TwoVersions& versions,
                                        const std::optional<Property>& property);

}  // namespace clew::hunt
