// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "process/domain_hold.hpp"
#include "process/link.hpp"

namespace clew::bridge {

/// Takes connections on a run's domain until each has said who it is.
class Reception {
 public:
  explicit Reception(const DomainHold& hold) : hold_(hold) {}

  /// What to poll: the listening socket, and those that have not spoken yet.
  std::vector<int> sockets() const;
  /// Components that have said hello since the last call. Who says something else is shown the
  /// door.
  std::vector<std::pair<std::unique_ptr<Link>, Hello>> arrivals();

 private:
  const DomainHold& hold_;
  std::vector<std::unique_ptr<Link>> newcomers_;
};

}  // namespace clew::bridge
