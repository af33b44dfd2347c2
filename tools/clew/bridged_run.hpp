// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "clew/run_options.hpp"
#include "core/result.hpp"
#include "supervisor/child_process.hpp"

namespace clew::tools {

/// `clew bridge ros2` beside a run, a process that ends with it.
class BridgedRun {
 public:
  /// Starts it for the run that will be found as `run`, if the options ask for it.
  static core::Result<BridgedRun> start(const RunOptions& options, const std::string& run);
  /// Gives it a moment to say that the run is over; then it is told to end.
  ~BridgedRun();
  /// Tells it to end: there is no run that it could see the end of.
  void stop();
  BridgedRun(BridgedRun&&) noexcept = default;
  BridgedRun& operator=(BridgedRun&&) = delete;

 private:
  BridgedRun() = default;

  std::unique_ptr<bridge::ChildProcess> process_;  ///< null: none was asked for
};

}  // namespace clew::tools
