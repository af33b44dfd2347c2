// SPDX-License-Identifier: Apache-2.0
#include "runtime/intervention.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#include "runtime/goals.hpp"

namespace clew::runtime {
namespace {

using core::Error;
using core::Result;

Error refused(std::string why) { return {std::move(why)}; }

bool is_goal(const std::string& change) { return change.rfind(kGoalChange, 0) == 0; }

/// Whether what stands before `=` names a choice and not a parameter.
bool names_choice(const std::string& change, const std::vector<StageInfo>& stages) {
  const std::string left = change.substr(0, change.find('='));
  for (const StageInfo& stage : stages) {
    if (left == stage.name) return true;
    for (const PartInfo& part : stage.parts) {
      if (left == stage.name + '.' + part.name) return true;
    }
  }
  return false;
}

Result<GraphOverrides> overrides_of(const std::vector<std::string>& changes,
                                    const std::vector<StageInfo>& stages) {
  GraphOverrides overrides;
  for (const std::string& change : changes) {
    if (change.find('=') == std::string::npos) {
      return refused("found '" + change +
                     "'; allowed: STAGE.PART=NAME, STAGE.PARAM=VALUE or goal=X,Y");
    }
    if (is_goal(change)) {
      if (overrides.goals) return refused("the goal is given twice; once is allowed");
      auto goals = parse_goals(change.substr(std::string(kGoalChange).size()));
      if (!goals.ok()) return goals.error();
      overrides.goals = std::move(goals).value();
    } else {
      (names_choice(change, stages) ? overrides.with : overrides.set).push_back(change);
    }
  }
  return overrides;
}

bool is_equal(const domain::ScanLayout& a, const domain::ScanLayout& b) {
  const auto curve = [](const domain::ScanLayout& layout) {
    const auto& c = layout.infrared_curve;
    return c ? std::optional(std::pair(c->gain_m, c->offset)) : std::nullopt;
  };
  return a.beam_count == b.beam_count && a.bearing_first_rad == b.bearing_first_rad &&
         a.bearing_step_rad == b.bearing_step_rad && a.beam_width_rad == b.beam_width_rad &&
         a.range_max_m == b.range_max_m && curve(a) == curve(b);
}

bool differs(const GraphStage& before, const GraphStage& after) {
  return before.expanded_yaml() != after.expanded_yaml();
}

/// Whether the stage's component is told where the mission ends.
bool knows_target(const GraphStage& stage) {
  return stage.ports.outputs[index_of(Topic::kState)] ||
         stage.ports.outputs[index_of(Topic::kTarget)];
}

Result<void> check_stage(const GraphStage& after) {
  const std::string& name = after.info->name;
  if (!after.deployment.is_ours()) {
    return refused(name + " is a component of someone else's: it cannot be changed from here");
  }
  if (after.ports.delayed_inputs.any()) {
    return refused(name + " is the robot: while it drives, only its goal can be changed");
  }
  return {};
}

/// Nobody could tell a program of somebody else's that the goal is another one.
Result<void> check_goal_is_ours(const RunPlan& plan) {
  for (const GraphStage& stage : plan.graph.stages) {
    if (stage.deployment.exec.empty() || !knows_target(stage)) continue;
    return refused(stage.info->name +
                   " is a component of someone else's: its goal cannot be changed from here");
  }
  return {};
}

/// A new planner is fed the last ticks only: it would not know which way-points were passed before.
Result<void> check_way_is_known(const RunPlan& after, const GraphStage& stage) {
  if (!stage.ports.outputs[index_of(Topic::kTarget)]) return {};
  if (after.setup.world->waypoints().size() < 2) return {};
  return refused(stage.info->name +
                 " cannot be changed on a mission of several way-points: a new one would not know "
                 "which were passed");
}

/// What other components were told once is as it was.
Result<void> check_succession(const RunPlan& before, const RunPlan& after) {
  bool any = goals_yaml(before.graph.goals) != goals_yaml(after.graph.goals);
  if (any) CLEW_RETURN_IF_ERROR(check_goal_is_ours(after));
  for (const GraphStage& stage : after.graph.stages) {
    if (!differs(*before.graph.find(stage.info->name), stage)) continue;
    any = true;
    CLEW_RETURN_IF_ERROR(check_stage(stage));
    CLEW_RETURN_IF_ERROR(check_way_is_known(after, stage));
  }
  if (!any) return refused("that is as it is already: nothing would change");
  const domain::BehaviourSetup& then = before.setup.behaviour;
  const domain::BehaviourSetup& now = after.setup.behaviour;
  if (before.graph.tick_s != after.graph.tick_s) {
    return refused(fmt::format("a tick would last {} s instead of {} s", after.graph.tick_s,
                               before.graph.tick_s));
  }
  if (!is_equal(then.scan, now.scan)) {
    return refused(
        fmt::format("the scan would have other beams, those of {} instead of {}: the "
                    "other stages were made for these",
                    now.scan.sensor, then.scan.sensor));
  }
  return {};
}

/// Makes what is new once, to see that it can be made.
Result<void> check_made(const RunPlan& before, const RunPlan& after) {
  for (const GraphStage& stage : after.graph.stages) {
    if (!differs(*before.graph.find(stage.info->name), stage)) continue;
    const auto node = make_node(after, stage);
    if (!node.ok()) return node.error();
  }
  return {};
}

void note_new_files(const Bundle& before, const Bundle& after, Bundle& files) {
  static const std::set<std::string> kOfEveryRun = {"graph.yaml", "world.yaml", "robot.yaml"};
  for (const auto& [name, text] : after) {
    if (before.count(name) == 0 && kOfEveryRun.count(name) == 0) files[name] = text;
  }
}

/// Finds nothing: a run that was prepared has all its files.
class NoFiles : public ConfigSource {
 public:
  Result<core::Resource> find(const std::string& folder, const std::string& name) const override {
    return refused("the run has no file '" + name + "' of " + folder);
  }
};

Result<RunPlan> read_change(const RunPlan& before, const ConfigSource& files,
                            const std::vector<StageInfo>& stages, const Intervention& intervention,
                            const std::optional<std::string>& only) {
  const auto overrides = overrides_of(intervention.changes, stages);
  if (!overrides.ok()) return overrides.error();
  Bundle bundle = before.bundle;
  bundle.insert(intervention.files.begin(), intervention.files.end());
  auto after = read_changed_run(*overrides, BundleAndFiles(bundle, files), stages, only);
  if (!after.ok()) return after.error();
  // What the run has it keeps, so that a later change may go back.
  after->bundle.insert(bundle.begin(), bundle.end());
  after->graph.name = before.graph.name;
  return after;
}

}  // namespace

Intervention planned_at(std::uint64_t tick, std::vector<std::string> changes) {
  return {tick, tick - std::min(tick, kFedTicks), std::move(changes), {}, {}};
}

Result<Intervention> read_intervention(const std::string& text, const std::string& option) {
  std::uint64_t tick = 0;
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const auto [stop, error] = std::from_chars(begin, end, tick);
  if (error != std::errc() || stop == end || *stop != ':' || stop + 1 == end) {
    return Error{"found '" + text +
                     "'; expected TICK:STAGE.PART=NAME, TICK:STAGE.PARAM=VALUE or TICK:goal=X,Y",
                 option};
  }
  if (tick == 0) {
    return Error{"tick 0 is where the run begins: change the graph itself, with --with or --set",
                 option};
  }
  return planned_at(tick, {std::string(stop + 1, end)});
}

Result<RunPlan> change(const RunPlan& before, const ConfigSource& files,
                       const std::vector<StageInfo>& stages, Intervention& intervention) {
  auto after = read_change(before, files, stages, intervention, std::nullopt);
  if (!after.ok()) return after.error();
  CLEW_RETURN_IF_ERROR(check_succession(before, *after));
  CLEW_RETURN_IF_ERROR(check_made(before, *after));
  note_new_files(before.bundle, after->bundle, intervention.files);
  return after;
}

Result<PlanSequence> change_all(const RunPlan& first,
                                const std::vector<Intervention>& interventions,
                                const std::vector<StageInfo>& stages,
                                const std::optional<std::string>& only) {
  PlanSequence plans;
  std::shared_ptr<const RunPlan> before = std::make_shared<const RunPlan>(first);
  for (const Intervention& intervention : interventions) {
    if (!intervention.changes.empty()) {
      Intervention read = intervention;
      auto after = only ? read_change(*before, NoFiles(), stages, intervention, only)
                        : change(*before, NoFiles(), stages, read);
      if (!after.ok()) return after.error();
      before = std::make_shared<const RunPlan>(std::move(after).value());
    }
    plans.push_back(before);
  }
  return plans;
}

// A plan's own bundle holds what the plan needs; that of a run also what its changes need.
Result<Bundle> changed_bundle(const Bundle& bundle, const std::vector<Intervention>& interventions,
                              const std::vector<StageInfo>& stages) {
  auto first = prepare_run(bundle, stages);
  if (!first.ok()) return first.error();
  first->bundle.insert(bundle.begin(), bundle.end());
  const auto plans = change_all(*first, interventions, stages);
  if (!plans.ok()) return plans.error();
  return plans->empty() ? first->bundle : plans->back()->bundle;
}

std::optional<Successor> successor(const RunPlan& before,
                                   const std::shared_ptr<const RunPlan>& after,
                                   const Intervention& intervention, const std::string& stage,
                                   const MakeNode& make) {
  const GraphStage* const then = before.graph.find(stage);
  const GraphStage* const now = after->graph.find(stage);
  const bool is_new = differs(*then, *now);
  const bool has_new_goal =
      knows_target(*now) && goals_yaml(before.graph.goals) != goals_yaml(after->graph.goals);
  if (!is_new && !has_new_goal) return std::nullopt;
  return Successor{intervention.tick, intervention.fed_from, intervention.tick, !is_new,
                   [after, now, make] {
                     auto node = make(*after, *now);
                     CLEW_CHECK(node.ok(), node.ok() ? "" : node.error().text());
                     return std::move(node).value();
                   }};
}

void add_successors(const RunPlan& first, const std::vector<Intervention>& interventions,
                    const PlanSequence& plans, NodeSuccession& node, const MakeNode& make) {
  const RunPlan* before = &first;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (auto next = successor(*before, plans[i], interventions[i], node.name(), make)) {
      node.add(std::move(*next));
    }
    before = plans[i].get();
  }
}

Result<std::vector<NodeSuccession>> make_successions(const RunPlan& first,
                                                     const std::vector<Intervention>& interventions,
                                                     const PlanSequence& plans) {
  auto nodes = make_nodes(first);
  if (!nodes.ok()) return nodes.error();
  std::vector<NodeSuccession> successions = alone(std::move(nodes).value());
  for (NodeSuccession& node : successions) add_successors(first, interventions, plans, node);
  return successions;
}

}  // namespace clew::runtime
