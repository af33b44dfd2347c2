// SPDX-License-Identifier: Apache-2.0
#include "runtime/wiring.hpp"

#include <algorithm>

#include "runtime/on_demand.hpp"

namespace clew::runtime {
namespace {

using core::Result;

std::string quoted(Topic topic) { return "'" + std::string(domain::topic_name(topic)) + "'"; }

// The topics that stages write with outputs of this need. Two writers are an error.
Result<TopicSet> written_topics(const Graph& graph, PortInfo::Need need) {
  TopicSet written;
  std::array<std::string, domain::kTopicCount> writers;
  for (const GraphStage& stage : graph.stages) {
    for (const PortInfo& port : stage.info->ports) {
      if (port.direction != PortInfo::Direction::kOutput || port.need != need) continue;
      std::string& writer = writers[index_of(port.topic)];
      if (!writer.empty()) {
        return stage.place.error(quoted(port.topic) + " has two writers: " + writer + " and " +
                                 stage.info->name);
      }
      writer = stage.info->name;
      written.set(index_of(port.topic));
    }
  }
  return written;
}

// Calls `see(part, variant)` for each behaviour that a stage's configuration chooses.
template <typename See>
void for_each_choice(const GraphStage& stage, const See& see) {
  for (const PartInfo& part : stage.info->parts) {
    const auto chosen = stage.config.parts.find(part.name);
    if (chosen == stage.config.parts.end()) continue;
    for (const PartChoice& choice : chosen->second) {
      for (const VariantInfo& variant : part.variants) {
        if (variant.name == choice.name) see(part, variant);
      }
    }
  }
}

Result<void> check_needs(const GraphStage& stage, const TopicSet& written) {
  std::string unmet;
  for_each_choice(stage, [&](const PartInfo& part, const VariantInfo& variant) {
    const TopicSet missing = variant.needs & ~written;
    if (!unmet.empty() || missing.none()) return;
    std::string topics;
    for (Topic topic : domain::kAllTopics) {
      if (missing[index_of(topic)]) topics += (topics.empty() ? "" : ", ") + quoted(topic);
    }
    unmet = stage.info->name + '.' + part.name + " '" + variant.name + "' needs " + topics +
            ", and no stage of this graph writes it";
  });
  if (!unmet.empty()) return stage.place.error(unmet);
  return {};
}

// Reads what the chosen behaviours need and is there for it.
void wire_on_demand(GraphStage& stage, const TopicSet& written) {
  TopicSet needed;
  for_each_choice(stage,
                  [&](const PartInfo&, const VariantInfo& variant) { needed |= variant.needs; });
  for (const PortInfo& port : stage.info->ports) {
    const std::size_t index = index_of(port.topic);
    if (is_on_demand(port) && needed[index] && written[index]) stage.ports.inputs.set(index);
  }
}

Result<void> check_ports(GraphStage& stage, const TopicSet& written, const TopicSet& taken_over,
                         Graph& graph) {
  stage.ports = resolve_ports(*stage.info, written, taken_over);
  wire_on_demand(stage, written);
  for (const PortInfo& port : stage.info->ports) {
    const bool is_written = written[index_of(port.topic)];
    if (port.direction == PortInfo::Direction::kOutput || is_written) continue;
    if (is_on_demand(port)) continue;  // if it is needed, check_needs says who needs it
    if (port.need == PortInfo::Need::kOptional) {
      graph.unwired.push_back(stage.info->name + '.' + std::string(domain::topic_name(port.topic)));
      continue;
    }
    if (port.need == PortInfo::Need::kFallback && written[index_of(port.instead_of)]) continue;
    return stage.place.error(stage.info->name + " needs " + quoted(port.topic) +
                             ", and no stage of this graph writes it");
  }
  return check_needs(stage, written);
}

bool is_still_read(const GraphStage& stage, const std::vector<GraphStage>& left) {
  return std::any_of(left.begin(), left.end(), [&](const GraphStage& reader) {
    return (reader.ports.delayed_inputs & stage.ports.outputs).any();
  });
}

// Repeatedly takes the first stage whose inputs of the same tick are all written by stages taken,
// and whose outputs no stage left reads of the tick before.
Result<void> order_stages(Graph& graph) {
  std::vector<GraphStage> ordered;
  std::vector<GraphStage> left = std::move(graph.stages);
  TopicSet done;
  while (!left.empty()) {
    const auto next = std::find_if(left.begin(), left.end(), [&](const GraphStage& stage) {
      return (stage.ports.inputs & ~done).none() && !is_still_read(stage, left);
    });
    if (next == left.end()) {
      std::string names;
      for (const GraphStage& stage : left) names += (names.empty() ? "" : ", ") + stage.info->name;
      return left.front().place.error("these stages wait for one another within a tick: " + names +
                                      "; only an input of the tick before may close a cycle");
    }
    done |= next->ports.outputs;
    ordered.push_back(std::move(*next));
    left.erase(next);
  }
  graph.stages = std::move(ordered);
  return {};
}

}  // namespace

Result<void> wire(Graph& graph) {
  const auto firm = written_topics(graph, PortInfo::Need::kRequired);
  if (!firm.ok()) return firm.error();
  const auto fallback = written_topics(graph, PortInfo::Need::kFallback);
  if (!fallback.ok()) return fallback.error();
  for (GraphStage& stage : graph.stages) {
    CLEW_RETURN_IF_ERROR(check_ports(stage, *firm | *fallback, *firm, graph));
  }
  return order_stages(graph);
}

}  // namespace clew::runtime
