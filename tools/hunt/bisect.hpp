// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hunt/case_run.hpp"
#include "hunt/property.hpp"
#include "hunt/run_trace.hpp"
#include "runtime/config_source.hpp"

namespace clew::hunt {

/// One of two runs: all that decides it, and what it is called.
struct BisectSide {
  std::string name;
  runtime::Bundle bundle;
};

/// A setting in which the two runs differ, and what it does alone: in run A, with B's value.
struct BisectSetting {
  std::string name;  ///< `control.guard_margin_m`, or a file of the run, as `world.yaml`
  std::string a;     ///< its values; of a file, nothing
  std::string b;
  std::optional<FirstDifference> first;  ///< none: not a byte differs, or it was refused
  std::string outcome;
  bool changes_verdict = false;
  std::string refused;  ///< why it cannot be changed alone; empty: it can
};

struct BisectEnd {
  std::string outcome_a;
  std::string outcome_b;
  bool verdicts_differ = false;
  std::vector<BisectSetting> settings;  ///< the first that matters first
  /// The smallest set of settings that gives A the verdict of B, by index: none can be left out.
  /// Empty if the verdicts do not differ.
  std::vector<std::size_t> cause;
  std::size_t runs = 0;
  bool interrupted = false;
};

/// What of the differences between two runs matters: each is put into run A alone, and the tick and
/// topic found at which that run begins to differ; and, if the verdicts differ, the fewest that
/// together give B's verdict, by delta debugging as isolation of failure causes (Zeller 1999,
/// "Yesterday, my program worked. Today, it does not. Why?"). A verdict is whether `property`
/// holds, or else the outcome. Settings that do not fit together without others count as not B's.
///
/// Refused: runs that cannot be made in one process.
core::Result<BisectEnd> bisect(const BisectSide& a, const BisectSide& b,
                               const std::optional<Property>& property,
                               const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::hunt
