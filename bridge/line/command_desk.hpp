// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "line/link.hpp"

namespace clew::bridge {

/// What somebody who commands a run says that he is, in his hello.
inline constexpr char kCommander[] = "commander";

/// Takes commands of people and programs, one a line. Nobody is waited for: who sends nothing for
/// kHelloTimeout, or more than kMostCommanders at a time, is shown the door.
class CommandDesk {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void welcome(std::unique_ptr<Link> link, Time now);
  std::vector<pollfd> descriptors() const;
  /// Calls `decide` for each command that has arrived and has an answer by now; none: it is asked
  /// again at the next call.
  void serve(const std::function<std::optional<CommandAnswer>(RunCommand&)>& decide, Time now);

 private:
  struct Visitor {
    std::unique_ptr<Link> link;
    Time came_at;
    std::optional<RunCommand> command = std::nullopt;
    bool answered = false;
  };
  std::deque<Visitor> visitors_;  ///< the first to come first
};

/// Whether what somebody calls a run is the number of a domain; else it is a name.
bool is_domain_number(const std::string& run);

/// A socket on the line of the run that `run` is. Refused: when there is no such run.
core::Result<int> connect_to_run(const std::string& run);

/// The two halves of it, for who does not wait: says on the line of a run who it is and what it
/// wants, and reads what the run says to that.
void post_command(Link& link, const RunCommand& command);
core::Result<CommandAnswer> answer_of(const Frame& frame);

/// Tells the run that `run` is, the number of a domain or a name, and waits for its answer.
/// Refused: when there is no such run, and what the run refuses.
core::Result<CommandAnswer> command_run(const std::string& run, const RunCommand& command);

}  // namespace clew::bridge
