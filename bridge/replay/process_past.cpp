// SPDX-License-Identifier: Apache-2.0
#include "replay/process_past.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "supervisor/member.hpp"
#include "supervisor/third_party_observer.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;
using runtime::GraphStage;

/// Stands where a component without a state is to begin, and never steps.
class Stateless final : public runtime::Component {
 public:
  void step(const runtime::TickInputs& /*inputs*/, runtime::TickOutputs& /*outputs*/) override {}
  void save(core::StateWriter& /*writer*/) const override {}
  void load(core::StateReader& /*reader*/) override {}
};

}  // namespace

bool has_third_party(const runtime::RunPlan& plan) {
  return std::any_of(plan.graph.stages.begin(), plan.graph.stages.end(),
                     [](const GraphStage& stage) { return !stage.deployment.is_ours(); });
}

core::Result<std::vector<runtime::Node>> make_own_nodes(const runtime::RunPlan& plan) {
  runtime::RunPlan ours = plan;
  ours.graph.stages.clear();
  for (const GraphStage& stage : plan.graph.stages) {
    if (stage.deployment.is_ours()) {
      ours.graph.stages.push_back(stage);
      continue;
    }
    const bool is_robot = stage.ports.delayed_inputs.any();
    if (stage.deployment.stateless && !is_robot) continue;
    return core::Error{stage.info->name + (stage.deployment.ros2 ? " has ros2" : " has exec") +
                       ", and no recording has its state" +
                       (is_robot ? "" : "; allowed: one that is 'restart: stateless'")};
  }
  return runtime::make_nodes(ours);
}

ProcessPast::ProcessPast(const runtime::RunPlan& plan, bool spools)
    : plan_(plan),
      accounts_(plan.graph.stages.size(), SampleAccount(true, false)),
      spool_(false, spools) {}

void ProcessPast::add(const RecordedPast& past, const RecordedTick& recorded) {
  for (std::size_t i = 0; i < accounts_.size(); ++i) {
    const GraphStage& stage = plan_.graph.stages[i];
    for (Topic topic : stage.ports.output_order) {
      domain::visit_topic(topic, [&](auto constant) {
        const auto& message = std::get<constant.kIndex>(past.messages());
        accounts_[i].add(message, recorded.cdr(topic));
        spool_.add(message, recorded.cdr(topic));
        if (is_third_party(stage)) observed_.add(message, recorded.cdr(topic));
      });
      last_outputs_[index_of(topic)].assign(recorded.cdr(topic));
    }
  }
}

std::string ProcessPast::node_of(const RecordedPast& past, const GraphStage& stage,
                                 std::uint64_t tick) const {
  for (const FedNode& fed : past.nodes()) {
    if (fed.node().name() == stage.info->name) return fed.node().save();
  }
  runtime::Node node(stage.info->name, stage.ports, std::make_unique<Stateless>(),
                     plan_.graph.tick_s);
  node.begin_at(tick);
  return node.save();
}

ProcessStart ProcessPast::start(const RecordedPast& past, std::uint64_t tick) {
  ProcessStart start;
  start.next_tick = tick;
  if (tick == 0) return start;
  const auto bytes_of = [](SampleAccount& account) {
    core::StateWriter writer;
    writer(account);
    return writer.take();
  };
  for (std::size_t i = 0; i < accounts_.size(); ++i) {
    const GraphStage& stage = plan_.graph.stages[i];
    Checkpoint checkpoint{tick, node_of(past, stage, tick), bytes_of(accounts_[i]), {}};
    for (Topic topic : stage.ports.output_order) {
      checkpoint.last_outputs[std::string(domain::topic_name(topic))] =
          last_outputs_[index_of(topic)];
    }
    for (const FedNode& fed : past.nodes()) {
      if (fed.node().name() == stage.info->name)
        checkpoint.successors = fed.node().save_successors();
    }
    start.checkpoints[stage.info->name] = std::move(checkpoint);
  }
  start.checkpoints[kObserverName] = {tick, {}, bytes_of(observed_), {}};
  start.spooled = spool_.take_spooled();
  return start;
}

}  // namespace clew::bridge
