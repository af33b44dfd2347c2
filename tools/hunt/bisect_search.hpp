// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hunt/case_run.hpp"
#include "hunt/property.hpp"
#include "hunt/run_trace.hpp"

namespace clew::hunt {

/// Something in which two runs differ, and what it does alone: in run A, as it is in B.
struct BisectDifference {
  std::string name;  ///< `control.guard_margin_m`, a file of the run as `world.yaml`, or a stage
  std::string a;     ///< the values of a setting; of anything else, nothing
  std::string b;
  std::optional<FirstDifference> first;  ///< none: not a byte differs, or there is no such run
  std::string outcome;
  bool changes_verdict = false;
  std::string refused;  ///< why there is no such run; empty: there is
};

struct BisectEnd {
  std::string outcome_a;
  std::string outcome_b;
  bool verdicts_differ = false;
  std::vector<BisectDifference> differences;  ///< the first that matters first
  /// The smallest set of differences that gives A the verdict of B, by index: none can be left out.
  /// Empty if the verdicts do not differ.
  std::vector<std::size_t> cause;
  std::size_t runs = 0;
  bool interrupted = false;
};

/// Two runs, and those between them. A run gives no outcome if it was interrupted.
struct BisectProbe {
  using Outcome = core::Result<std::optional<CaseOutcome>>;

  std::vector<BisectDifference> differences;  ///< their names and values
  /// Run A with these differences, by index, as they are in B.
  std::function<Outcome(const std::vector<std::size_t>& changed, RunTrace& trace)> run;
  std::function<Outcome(RunTrace& trace)> run_b;
};

/// What of the differences between two runs matters: each is put into run A alone, and the tick and
/// topic found at which that run begins to differ; and, if the verdicts differ, the fewest that
/// together give B's verdict, by delta debugging as isolation of failure causes (Zeller 1999,
/// "Yesterday, my program worked. Today, it does not. Why?"). A verdict is whether `property`
/// holds, or else the outcome. Differences that do not fit together without others count as not
/// B's.
///
/// Refused: what `probe` refuses of run A and of run B.
core::Result<BisectEnd> search_bisect(BisectProbe probe, const std::optional<Property>& property);

}  // namespace clew::hunt
