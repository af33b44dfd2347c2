// SPDX-License-Identifier: Apache-2.0
#include "runtime/node_succession.hpp"

#include <utility>

namespace clew::runtime {
namespace {

Node& made(Successor& successor) {
  if (!successor.node) {
    successor.node = successor.make();
    successor.node->begin_at(successor.fed_from);
  }
  return *successor.node;
}

bool is_fed(const Successor& successor, std::uint64_t tick) {
  return !successor.keeps_state && successor.fed_from <= tick && tick < successor.tick;
}

}  // namespace

void NodeSuccession::add(Successor successor) {
  CLEW_CHECK(successors_.empty() || successors_.back().tick <= successor.tick,
             "successors come in the order of their ticks");
  successors_.push_back(std::move(successor));
}

void NodeSuccession::feed(Successor& successor, std::uint64_t tick, const TopicSet& present,
                          domain::Messages& messages) {
  made(successor).step(tick, present, messages);
}

void NodeSuccession::promote() {
  Successor next = std::move(successors_.front());
  successors_.pop_front();
  Node node = std::move(made(next));
  if (next.keeps_state) {
    const auto loaded = node.load(current_.save());
    CLEW_CHECK(loaded.ok(), loaded.ok() ? "" : loaded.error().text());
  }
  current_ = std::move(node);
}

// What a successor writes is overwritten by the node whose turn it is: each begins with outputs
// that are reset.
void NodeSuccession::step(std::uint64_t tick, const TopicSet& present, domain::Messages& messages,
                          PartObserver* parts) {
  while (!successors_.empty() && successors_.front().tick <= tick) promote();
  for (Successor& successor : successors_) {
    if (is_fed(successor, tick)) feed(successor, tick, present, messages);
  }
  current_.step(tick, present, messages, parts);
}

std::map<std::uint64_t, std::string> NodeSuccession::save_successors() const {
  std::map<std::uint64_t, std::string> states;
  for (const Successor& successor : successors_) {
    if (successor.node && !successor.keeps_state) states[successor.tick] = successor.node->save();
  }
  return states;
}

core::Result<void> NodeSuccession::load_successors(
    const std::map<std::uint64_t, std::string>& states) {
  for (Successor& successor : successors_) {
    const auto state = states.find(successor.tick);
    if (state != states.end()) CLEW_RETURN_IF_ERROR(made(successor).load(state->second));
  }
  return {};
}

core::Result<void> NodeSuccession::feed_past(
    std::uint64_t tick, const std::map<std::uint64_t, std::string>& fed,
    const std::function<core::Result<void>(Successor&)>& feed) {
  for (Successor& successor : successors_) {
    const bool needed = !successor.keeps_state && successor.fed_from < tick;
    if (needed && fed.count(successor.tick) == 0) CLEW_RETURN_IF_ERROR(feed(successor));
  }
  return {};
}

void NodeSuccession::skip_to(std::uint64_t tick) {
  while (!successors_.empty() && successors_.front().tick < tick) {
    current_ = std::move(made(successors_.front()));
    successors_.pop_front();
  }
}

std::vector<NodeSuccession> alone(std::vector<Node> nodes) {
  std::vector<NodeSuccession> successions;
  successions.reserve(nodes.size());
  for (Node& node : nodes) successions.emplace_back(std::move(node));
  return successions;
}

}  // namespace clew::runtime
