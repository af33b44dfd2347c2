// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/node_succession.hpp"

namespace clew::runtime {

/// Sees every sample that a node writes, in the order of writing.
class SampleObserver {
 public:
  virtual ~SampleObserver() = default;
  virtual void on_output(Topic topic, const domain::Messages& messages) = 0;
  /// Who is told of the parts of steps; null: nobody.
  virtual PartObserver* parts() { return nullptr; }
};

/// Runs the nodes of a graph in one thread. Values pass by reference: nothing is serialised.
class ComposedExecutor {
 public:
  /// `nodes` in an order in which every input of the same tick is written before it is read. The
  /// observer may be null.
  ComposedExecutor(std::vector<Node> nodes, SampleObserver* observer);
  /// Goes on from `next_tick`: the nodes have stepped every tick before it, and `messages` holds
  /// the samples of the last one.
  ComposedExecutor(std::vector<NodeSuccession> nodes, SampleObserver* observer,
                   std::uint64_t next_tick, domain::Messages messages);

  /// In the order of their steps. Successors may be added for ticks to come.
  std::vector<NodeSuccession>& nodes() { return nodes_; }
  const std::vector<NodeSuccession>& nodes() const { return nodes_; }
  /// The tick that step() runs next.
  std::uint64_t next_tick() const { return next_tick_; }
  /// Runs one tick of all nodes.
  void step();
  /// The samples of the last tick.
  const domain::Messages& messages() const { return messages_; }

 private:
  std::vector<NodeSuccession> nodes_;
  SampleObserver* observer_;
  domain::Messages messages_;
  std::uint64_t next_tick_ = 0;
};

}  // namespace clew::runtime
