// SPDX-License-Identifier: Apache-2.0
#include "line/acceptor.hpp"

#include <algorithm>

namespace clew::bridge {

std::vector<int> Acceptor::sockets() const {
  std::vector<int> sockets = {lock_.socket()};
  for (const auto& newcomer : newcomers_) sockets.push_back(newcomer->socket());
  return sockets;
}

std::vector<std::pair<std::unique_ptr<Link>, Hello>> Acceptor::arrivals() {
  while (const auto socket = lock_.accept()) newcomers_.push_back(std::make_unique<Link>(*socket));
  std::vector<std::pair<std::unique_ptr<Link>, Hello>> arrived;
  for (auto& newcomer : newcomers_) {
    if (!newcomer->receive()) {
      newcomer.reset();
    } else if (const auto frame = newcomer->next()) {
      auto hello = frame->as<Hello>();
      if (frame->type == FrameType::kHello && hello) {
        arrived.emplace_back(std::move(newcomer), *std::move(hello));
      }
      newcomer.reset();
    }
  }
  newcomers_.erase(std::remove(newcomers_.begin(), newcomers_.end(), nullptr), newcomers_.end());
  return arrived;
}

}  // namespace clew::bridge
