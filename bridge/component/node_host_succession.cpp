// SPDX-License-Identifier: Apache-2.0
/// How another behaviour takes the place of a node on the wire, and what is kept to feed it.
#include <algorithm>
#include <utility>

#include "component/node_host.hpp"

namespace clew::bridge {

// A successor that was announced after the checkpoint was saved is fed what the process before this
// one has kept.
core::Result<void> NodeHost::feed_past(const Checkpoint& checkpoint) {
  domain::Messages messages;
  return node_.feed_past(checkpoint.tick, checkpoint.successors,
                         [&](runtime::Successor& successor) -> core::Result<void> {
                           for (std::uint64_t tick = successor.fed_from; tick < checkpoint.tick;
                                ++tick) {
                             if (!history_)
                               return core::Error{"no inputs are kept to feed a successor"};
                             const auto present = history_->get(tick, messages);
                             if (!present.ok()) return present.error();
                             runtime::NodeSuccession::feed(successor, tick, *present, messages);
                           }
                           return {};
                         });
}

void NodeHost::expect_successor(std::uint64_t tick) {
  const std::lock_guard<std::mutex> lock(mutex_);
  expected_.insert(tick);
}

void NodeHost::forget_successor(std::uint64_t tick) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = expected_.find(tick);
  if (found != expected_.end()) expected_.erase(found);
  run_ready(std::chrono::steady_clock::now());
}

core::Result<void> NodeHost::take_successor(runtime::Successor successor) {
  const std::uint64_t planned = successor.tick;
  std::uint64_t fed = successor.fed_from;
  domain::Messages messages;
  while (true) {
    std::uint64_t end = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      end = buffer_.next_tick();
      if (successor.keeps_state || fed >= end) {
        // In real time the node before it has gone on.
        successor.tick = std::max(planned, buffer_.next_tick());
        if (!node_.successors().empty()) {
          successor.tick = std::max(successor.tick, node_.successors().back().tick);
        }
        node_.add(std::move(successor));
        expected_.erase(expected_.find(planned));
        run_ready(std::chrono::steady_clock::now());
        return {};
      }
    }
    for (; fed < end; ++fed) {
      if (!history_) return core::Error{"no inputs are kept to feed a successor"};
      const auto present = history_->get(fed, messages);
      if (!present.ok()) return present.error();
      runtime::NodeSuccession::feed(successor, fed, *present, messages);
    }
  }
}

// Nobody waits for it; a history that cannot be written is given up.
void NodeHost::keep_tick(std::uint64_t tick, const runtime::TopicSet& present) {
  if (!history_) return;
  const auto kept = history_->put(tick, present, messages_);
  if (kept.ok()) return;
  handlers_.on_notice(node_.name() + " keeps no inputs any more: " + kept.error().text());
  history_.reset();
}

void NodeHost::note_successions(std::uint64_t tick) {
  if (lockstep_ || !handlers_.on_took_over) return;
  for (const runtime::Successor& successor : node_.successors()) {
    if (successor.tick <= tick) {
      handlers_.on_took_over({node_.name(), successor.planned, tick});
    }
  }
}

}  // namespace clew::bridge
