// SPDX-License-Identifier: Apache-2.0
#include "line/acceptor.hpp"

#include <algorithm>

#include "run/limits.hpp"

namespace clew::bridge {

std::vector<int> Acceptor::sockets() const {
  std::vector<int> sockets = listening_;
  for (const Newcomer& newcomer : newcomers_) sockets.push_back(newcomer.link->socket());
  return sockets;
}

void Acceptor::add(std::unique_ptr<Link> link, Time now) {
  const bool stranger = !is_descendant(link->socket());
  newcomers_.push_back({std::move(link), now, stranger});
}

std::vector<Acceptor::Arrival> Acceptor::arrivals(Time now) {
  // No more at a time: who connects without end must not hold up the run.
  for (const int listening : listening_) {
    for (std::size_t i = 0; i < kMostNewcomers; ++i) {
      const auto socket = LinkListener::accept(listening, refusals_);
      if (!socket) break;
      add(std::make_unique<Link>(*socket, kMostHelloBytes), now);
    }
  }
  // Who has spoken is no newcomer any more, however many came after.
  std::vector<Arrival> arrived = greet(now);
  send_surplus_away();
  if (refusals_.size() > kMostNewcomers) refusals_.resize(kMostNewcomers);
  return arrived;
}

std::vector<Acceptor::Arrival> Acceptor::greet(Time now) {
  std::vector<Arrival> arrived;
  for (Newcomer& newcomer : newcomers_) {
    if (!newcomer.link->receive()) {
      turn_away(newcomer, "said no hello");
    } else if (now - newcomer.connected_at > kHelloTimeout) {
      turn_away(newcomer, "said nothing");
    } else if (const auto frame = newcomer.link->next()) {
      auto hello = frame->as<Hello>();
      if (frame->type == FrameType::kHello && hello) {
        newcomer.link->allow_payload(kMostPayloadBytes);
        arrived.emplace_back(std::move(newcomer.link), *std::move(hello));
        newcomer.link.reset();
      } else {
        turn_away(newcomer, "said no hello");
      }
    }
  }
  newcomers_.erase(std::remove_if(newcomers_.begin(), newcomers_.end(),
                                  [](const Newcomer& newcomer) { return !newcomer.link; }),
                   newcomers_.end());
  return arrived;
}

void Acceptor::send_surplus_away() {
  const auto is_stranger = [](const Newcomer& newcomer) { return newcomer.stranger; };
  auto strangers = std::count_if(newcomers_.begin(), newcomers_.end(), is_stranger);
  for (; strangers > static_cast<std::ptrdiff_t>(kMostNewcomers); --strangers) {
    const auto oldest = std::find_if(newcomers_.begin(), newcomers_.end(), is_stranger);
    turn_away(*oldest, "said nothing, and too many have come after it");
    newcomers_.erase(oldest);
  }
}

void Acceptor::turn_away(Newcomer& newcomer, const char* why) {
  if (newcomer.stranger) {
    refusals_.push_back(std::string("a process has connected and ") + why + "; it is turned away");
  }
  newcomer.link.reset();
}

}  // namespace clew::bridge
