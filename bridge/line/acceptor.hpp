// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "line/domain_lock.hpp"
#include "line/link.hpp"

namespace clew::bridge {

/// Takes connections on a run's domain until each has said who it is.
class Acceptor {
 public:
  explicit Acceptor(const DomainLock& hold) : lock_(hold) {}

  /// What to poll: the listening socket, and those that have not spoken yet.
  std::vector<int> sockets() const;
  /// Components that have said hello since the last call. Who says something else is shown the
  /// door.
  std::vector<std::pair<std::unique_ptr<Link>, Hello>> arrivals();

 private:
  const DomainLock& lock_;
  std::vector<std::unique_ptr<Link>> newcomers_;
};

}  // namespace clew::bridge
