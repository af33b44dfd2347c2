// SPDX-License-Identifier: Apache-2.0
#include "gateway/run_orders.hpp"

#include <unistd.h>

#include <optional>
#include <utility>

#include "line/command_desk.hpp"
#include "run/limits.hpp"

namespace clew::bridge {
namespace {

/// Half of what a run takes, so that terminals have their say, too.
constexpr std::size_t kMostOrders = kMostCommanders / 2;

core::Error no_answer(const char* why) { return {why}; }

}  // namespace

core::Result<void> RunOrders::send(const std::string& run, const RunCommand& command, Time now,
                                   Done done) {
  if (orders_.size() >= kMostOrders) return no_answer("too many orders wait for their answers");
  const auto socket = connect_to_run(run);
  if (!socket.ok()) return socket.error();
  auto link = std::make_unique<Link>(*socket);
  post_command(*link, command);
  orders_.push_back({std::move(link), now + kAssignmentTimeout, std::move(done)});
  return {};
}

bool RunOrders::poll(Time now) {
  for (auto order = orders_.begin(); order != orders_.end();) {
    order->link->flush();
    const bool open = order->link->receive();
    std::optional<core::Result<CommandAnswer>> answer;
    if (const auto frame = order->link->next()) {
      answer = answer_of(*frame);
    } else if (!open) {
      answer = no_answer("the run is over");
    } else if (now > order->until) {
      answer = no_answer("the run does not answer");
    }
    if (!answer) {
      ++order;
      continue;
    }
    const Done done = std::move(order->done);
    order = orders_.erase(order);
    done(*answer);
  }
  return !orders_.empty();
}

}  // namespace clew::bridge
