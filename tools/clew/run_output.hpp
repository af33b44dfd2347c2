// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/run_report.hpp"
#include "runtime/run_plan.hpp"

namespace clew::tools {

/// What a report does not know of its run.
struct RunFacts {
  std::string layout;
  std::string middleware;
  std::string recording;  ///< the file, or empty
  /// Where the run branched off a recorded one; none: it did not.
  std::optional<std::uint64_t> branch_tick = std::nullopt;
  /// Their ticks, in the order in which they came.
  std::vector<std::uint64_t> planned_changes = {};
  bool seed_given = false;  ///< by who started it
};

/// `reached`, ..., or `aborted`.
std::string outcome_word(const bridge::RunReport& report);

/// The exit status that the outcome asks for.
int exit_status(const bridge::RunReport& report);

/// What a reader of the result should know besides, in sentences: that the robot stood still for
/// the last minute and more, since when and why; that `unreachable` may be odometry's error; that a
/// change was planned for later than the run's end.
std::vector<std::string> notes_on(const bridge::RunReport& report, const runtime::RunPlan& plan,
                                  const RunFacts& facts);

/// The object that `run --json` prints, on one line.
std::string report_json(const bridge::RunReport& report, const runtime::RunPlan& plan,
                        const RunFacts& facts);

/// The same for people, in a line.
std::string report_line(const bridge::RunReport& report, const runtime::RunPlan& plan);

/// Shows progress in one line on the terminal; does nothing in a pipe.
bridge::ProgressDisplay terminal_display(const runtime::RunPlan& plan);
/// Clears that line.
void clear_display();

}  // namespace clew::tools
