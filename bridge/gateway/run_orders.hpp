// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <memory>
#include <string>

#include "core/result.hpp"
#include "line/link.hpp"

namespace clew::bridge {

/// Commands of a page on their way to a run, over the line that `clew pause` and the like use. A
/// few at once; nobody waits.
class RunOrders {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// What the run answered, or why it did not.
  using Done = std::function<void(const core::Result<CommandAnswer>&)>;

  /// Sends a command to the run that `run` is. Refused: one too many at once, and no such run.
  core::Result<void> send(const std::string& run, const RunCommand& command, Time now, Done done);
  /// Tells of those that have been answered, and gives up those that take too long. Whether any is
  /// left.
  bool poll(Time now);

 private:
  struct Order {
    std::unique_ptr<Link> link;
    Time until{};
    Done done;
  };

  std::list<Order> orders_;
};

}  // namespace clew::bridge
