// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hunt/property.hpp"
#include "hunt/run_trace.hpp"
#include "runtime/run_plan.hpp"

namespace clew::hunt {

/// Two builds of the clew command, as paths. The first one supervises and records every run.
struct TwoVersions {
  std::string own;
  std::string other;
};

/// A stage, and what it does alone: its component by the other version, all others by our own.
struct VersionStage {
  std::string stage;
  std::optional<FirstDifference> first;  ///< none: not a byte differs, or the run was aborted
  std::string outcome;
  bool changes_verdict = false;
  std::string aborted;  ///< why there is no such run; empty: there is
};

struct VersionBisectEnd {
  std::string outcome_own;
  std::string outcome_other;  ///< of all components by the other version
  bool verdicts_differ = false;
  std::vector<VersionStage> stages;  ///< the first that matters first
  /// The smallest set of stages that gives the verdict of the other version, by index.
  std::vector<std::size_t> cause;
  std::size_t runs = 0;
  bool interrupted = false;
};

/// Which component of another version matters: `plan` is run as processes, with each component by
/// the other version alone; and, if the verdict of a run of all of them is another one, with the
/// fewest that together give it (delta debugging, as hunt::bisect). A verdict is whether `property`
/// holds, or else the outcome.
///
/// Refused: an other version that cannot be started or has other messages (all its runs are
/// aborted), stages that share a process, and stages of somebody else's.
core::Result<VersionBisectEnd> bisect_versions(const runtime::RunPlan& plan,
                                               const TwoVersions& versions,
                                               const std::optional<Property>& property);

}  // namespace clew::hunt
