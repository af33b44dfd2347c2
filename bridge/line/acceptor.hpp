// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "line/domain_lock.hpp"
#include "line/link.hpp"

namespace clew::bridge {

/// Takes connections on a run's domain until each has said who it is. Who says something else, too
/// much, or nothing for kHelloTimeout is shown the door. So is the oldest of more than
/// kMostNewcomers strangers: processes that neither this one nor one of its children started.
class Acceptor {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Arrival = std::pair<std::unique_ptr<Link>, Hello>;

  explicit Acceptor(const DomainLock& lock) : Acceptor(std::vector<int>{lock.socket()}) {}
  /// Takes what connects to any of these listening sockets, which stay others'.
  explicit Acceptor(std::vector<int> listening) : listening_(std::move(listening)) {}

  /// What to poll: the listening socket, and those that have not spoken yet.
  std::vector<int> sockets() const;
  /// Processes that have said hello since the last call.
  std::vector<Arrival> arrivals(Time now);
  /// Who was turned away since the last call, a sentence each: of other users, and strangers.
  /// Of more than kMostNewcomers the first are told.
  std::vector<std::string> take_refusals() { return std::exchange(refusals_, {}); }
  /// A connection as accept() gives it; for connections that come another way.
  void add(std::unique_ptr<Link> link, Time now);

 private:
  struct Newcomer {
    std::unique_ptr<Link> link;
    Time connected_at;
    bool stranger;
  };

  /// The hello of each newcomer who has said it.
  std::vector<Arrival> greet(Time now);
  void send_surplus_away();
  /// Closes the line of a newcomer; of one of the run's own there is nothing to tell.
  void turn_away(Newcomer& newcomer, const char* why);

  std::vector<int> listening_;
  std::vector<std::string> refusals_;
  std::deque<Newcomer> newcomers_;  ///< the oldest first
};

}  // namespace clew::bridge
