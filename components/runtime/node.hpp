// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "runtime/component.hpp"
#include "runtime/stage.hpp"

namespace clew::runtime {

/// Which topics somebody writes in a graph: from it follows what each port of each stage does.
struct NodePorts {
  TopicSet inputs;           ///< wired, of the same tick
  TopicSet delayed_inputs;   ///< wired, of the tick before
  TopicSet declared_inputs;  ///< wired or not
  TopicSet outputs;
  std::vector<Topic> output_order;  ///< as declared: the most urgent first

  TopicSet all_inputs() const { return inputs | delayed_inputs; }
};

/// The ports of a stage where `written` are the topics that have a writer, and `taken_over` those
/// of its fallback outputs that have another.
NodePorts resolve_ports(const StageInfo& stage, const TopicSet& written,
                        const TopicSet& taken_over = {});

/// A component at its ports: stamps its outputs and keeps count of them. It knows nothing of where
/// samples come from and go to.
class Node {
 public:
  Node(std::string name, NodePorts ports, std::unique_ptr<Component> component, double tick_s);

  const std::string& name() const { return name_; }
  const NodePorts& ports() const { return ports_; }

  /// Steps the component for `tick`. `messages` holds the inputs in `present` and takes the
  /// outputs. `parts` may be null.
  void step(std::uint64_t tick, const TopicSet& present, domain::Messages& messages,
            PartObserver* parts = nullptr);

  /// Takes its place in a run that has got to `tick` without it: so many samples of each output
  /// were written by another.
  void begin_at(std::uint64_t tick) { next_sequence_.fill(tick); }

  /// What the component tells of its last step, which was that of `tick` with these samples.
  domain::Inside inside(std::uint64_t tick, const TopicSet& present,
                        const domain::Messages& messages) const;

  /// The component's state and the counts of its outputs, as bytes.
  std::string save() const;
  core::Result<void> load(const std::string& bytes);

 private:
  std::string name_;
  NodePorts ports_;
  std::unique_ptr<Component> component_;
  double tick_s_;
  std::array<std::uint64_t, domain::kTopicCount> next_sequence_{};
};

}  // namespace clew::runtime
