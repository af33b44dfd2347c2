// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <memory>
#include <string>
#include <vector>

#include "line/frames.hpp"
#include "line/link.hpp"

namespace clew::bridge {

/// The lines of processes that only look on at a run. What they do changes nothing in it.
class Watchers {
 public:
  /// Tells a watcher what the run is; says why not to one of other message types, or to one too
  /// many.
  void welcome(std::unique_ptr<Link> link, const Hello& hello, Assignment run);
  /// Sends what waits, and forgets those that have gone.
  void turn();
  /// A line of the run's log, for those that pass it on.
  void tell(const std::string& line);
  void add_descriptors(std::vector<pollfd>& descriptors) const;

 private:
  std::vector<std::unique_ptr<Link>> links_;
};

}  // namespace clew::bridge
