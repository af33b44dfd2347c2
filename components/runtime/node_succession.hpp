// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/node.hpp"

namespace clew::runtime {

/// A node that takes another's place.
struct Successor {
  std::uint64_t tick = 0;      ///< the first that it steps for the run
  std::uint64_t fed_from = 0;  ///< from this tick on it steps beside the other, and writes nothing
  std::uint64_t planned = 0;   ///< as `tick`, but for one that was not ready in time
  bool keeps_state = false;    ///< takes over the other's state at `tick`, and is fed nothing
  std::function<Node()> make;
  std::optional<Node> node = std::nullopt;  ///< made once it is needed
};

/// A node and those that take its place at set ticks. Which node writes a sample follows from the
/// ticks alone, and what a successor was fed as well: so a run with successors is as repeatable as
/// one without.
class NodeSuccession {
 public:
  explicit NodeSuccession(Node node) : current_(std::move(node)) {}

  const Node& current() const { return current_; }
  const std::string& name() const { return current_.name(); }
  const NodePorts& ports() const { return current_.ports(); }

  /// `successor` takes over at a tick that is not stepped yet, after those that were added before.
  void add(Successor successor);
  /// Those to come.
  const std::deque<Successor>& successors() const { return successors_; }

  /// Node::step of the node whose turn it is; successors that are being fed step before it.
  void step(std::uint64_t tick, const TopicSet& present, domain::Messages& messages,
            PartObserver* parts = nullptr);

  /// Steps one that is to come with inputs of a tick that has been.
  static void feed(Successor& successor, std::uint64_t tick, const TopicSet& present,
                   domain::Messages& messages);

  /// Node::save and Node::load of the node whose turn it is.
  std::string save() const { return current_.save(); }
  core::Result<void> load(const std::string& bytes) { return current_.load(bytes); }
  /// The states of successors that are being fed, by the tick at which each takes over.
  std::map<std::uint64_t, std::string> save_successors() const;
  core::Result<void> load_successors(const std::map<std::uint64_t, std::string>& states);

  /// Calls `feed` for each successor that had to be fed before `tick` and is not in `fed`.
  core::Result<void> feed_past(std::uint64_t tick, const std::map<std::uint64_t, std::string>& fed,
                               const std::function<core::Result<void>(Successor&)>& feed);

  /// Goes to a tick of which the state will be loaded: nodes whose turn is over are gone.
  void skip_to(std::uint64_t tick);

  /// Node::begin_at.
  void begin_at(std::uint64_t tick) { current_.begin_at(tick); }
  /// Node::inside of the node whose turn it was.
  domain::Inside inside(std::uint64_t tick, const TopicSet& present,
                        const domain::Messages& messages) const {
    return current_.inside(tick, present, messages);
  }

 private:
  void promote();

  Node current_;
  std::deque<Successor> successors_;  ///< the next one first
};

/// Nodes whose place nobody takes.
std::vector<NodeSuccession> alone(std::vector<Node> nodes);

}  // namespace clew::runtime
