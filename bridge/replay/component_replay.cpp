// SPDX-License-Identifier: Apache-2.0
#include "replay/component_replay.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>

#include "core/nearest_name.hpp"
#include "replay/black_box_past.hpp"
#include "replay/fed_node.hpp"
#include "replay/recorded_plan.hpp"
#include "run/tick_clock.hpp"

namespace clew::bridge {
namespace {

using core::Result;
using domain::Topic;

/// Compares a node's outputs with the recorded ones and keeps the account.
class OutputComparison {
 public:
  explicit OutputComparison(ReplayReport& report) : report_(report) {}

  /// A topic that has ended was cut off: there is nothing to compare with.
  void compare(const FedNode& fed, const RecordedTick& recorded) {
    const runtime::TopicSet compared = fed.node().ports().outputs & ~recorded.ended();
    if (compared.none()) return;
    bool different = false;
    for (Topic topic : domain::kAllTopics) {
      if (!compared[index_of(topic)]) continue;
      auto fields = compare_output(topic, fed, recorded);
      if (fields.empty()) continue;
      different = true;
      if (report_.first) continue;
      report_.first = {topic, recorded.tick(), std::move(fields)};
      list_inputs(fed);
    }
    ++report_.ticks;
    if (different) ++report_.different_ticks;
  }

 private:
  std::vector<FieldDifference> compare_output(Topic topic, const FedNode& fed,
                                              const RecordedTick& recorded) {
    if (!recorded.has(topic)) return missing_sample(true);
    const std::string_view replayed = domain::visit_topic(topic, [&](auto constant) {
      return std::get<constant.kIndex>(codecs_).encode(std::get<constant.kIndex>(fed.messages()));
    });
    return comparison_.compare(topic, recorded.cdr(topic), replayed);
  }

  void list_inputs(const FedNode& fed) {
    for (Topic topic : domain::kAllTopics) {
      if (!fed.inputs_present()[index_of(topic)]) continue;
      domain::visit_topic(topic, [&](auto constant) {
        report_.inputs.push_back({topic, fields_of(std::get<constant.kIndex>(fed.messages()))});
      });
    }
  }

  ReplayReport& report_;
  SampleComparison comparison_;
  Codecs codecs_;
};

Result<runtime::Node> node_of(const runtime::RunPlan& plan, const std::string& stage) {
  const auto found = find_stage(plan, stage);
  if (!found.ok()) return found.error();
  if ((*found)->deployment.ros2) {
    return core::Error{stage + " was a robot of ROS 2: what it told is in the recording"};
  }
  if (!(*found)->deployment.exec.empty()) {
    return core::Error{stage +
                       " is a third-party component: --publish feeds it what was recorded and "
                       "compares what it writes, --start starts it for that"};
  }
  return runtime::make_node(plan, **found);
}

core::Error no_tick(const RunRecording& recording, std::uint64_t tick,
                    const std::optional<std::uint64_t>& last) {
  return {fmt::format("has no tick {}; {}", tick,
                      last ? fmt::format("its last one is {}", *last) : "it has none"),
          recording.path()};
}

/// The component of a stage, to be fed from the recording.
Result<FedNode> fed_node_of(const RunRecording& recording, const runtime::RunPlan& plan,
                            const std::string& stage) {
  auto node = node_of(plan, stage);
  if (!node.ok()) return node.error();
  std::optional<HandOver> hand_over;
  if (node->ports().delayed_inputs.any()) {
    auto branch = branch_of(recording);
    if (!branch.ok()) return branch.error();
    hand_over = std::move(branch).value();
  }
  const auto changes = recorded_changes(recording, plan, *plan.known_stages);
  if (!changes.ok()) return changes.error();
  runtime::NodeSuccession succession(std::move(node).value());
  runtime::add_successors(plan, changes->interventions, changes->plans, succession);
  FedNode fed(std::move(succession), std::move(hand_over));
  CLEW_RETURN_IF_ERROR(begin_in_black_box(recording, plan, fed));
  return fed;
}

}  // namespace

Result<const runtime::GraphStage*> find_stage(const runtime::RunPlan& plan,
                                              const std::string& stage) {
  if (const runtime::GraphStage* found = plan.graph.find(stage)) return found;
  std::vector<std::string> known;
  for (const auto& candidate : plan.graph.stages) known.push_back(candidate.info->name);
  return core::Error{core::unknown_name("stage of this recording", stage, known)};
}

Result<void> check_recorded(const RunRecording& recording, const std::string& stage,
                            const runtime::TopicSet& topics) {
  for (Topic topic : domain::kAllTopics) {
    if (!topics[index_of(topic)]) continue;
    if (recording.description().schemas.count(topic) != 0) continue;
    const bool left_out = recording.description().left_out.count(topic) > 0;
    return core::Error{fmt::format("has no topic '{}'{}, without which {} cannot be replayed",
                                   domain::topic_name(topic),
                                   left_out ? " (--record-topics left it out)" : "", stage),
                       recording.path()};
  }
  return {};
}

Result<void> refuse_left_out(const RunRecording& recording, const std::string& so) {
  std::vector<std::string> names;
  for (const Topic topic : recording.description().left_out) {
    names.push_back(fmt::format("'{}'", domain::topic_name(topic)));
  }
  if (names.empty()) return {};
  return core::Error{
      fmt::format("lacks {}, which --record-topics left out: {}", fmt::join(names, ", "), so),
      recording.path()};
}

Result<void> check_range(const ReplayRange& range) {
  if (range.first_tick <= range.last_tick) return {};
  return core::Error{fmt::format("no tick is from {} to {}", range.first_tick, range.last_tick)};
}

Result<void> check_last_tick(const RunRecording& recording, std::uint64_t last_tick) {
  const auto there = recording.samples({{}, last_tick}).next();
  if (!there.ok()) return there.error();
  if (*there) return {};
  const auto survey = recording.survey_samples();
  if (!survey.ok()) return survey.error();
  std::optional<std::uint64_t> last;
  for (const auto& [topic, found] : survey->topics) {
    last = std::max(last.value_or(0), found.last_tick);
  }
  return no_tick(recording, last_tick, last);
}

Result<ReplayReport> replay_component(const RunRecording& recording, const runtime::RunPlan& plan,
                                      const std::string& stage, const ReplayRange& range) {
  CLEW_RETURN_IF_ERROR(check_range(range));
  auto made = fed_node_of(recording, plan, stage);
  if (!made.ok()) return made.error();
  FedNode& fed = *made;
  const runtime::TopicSet topics = fed.fed_topics() | fed.node().ports().outputs;
  CLEW_RETURN_IF_ERROR(check_recorded(recording, stage, topics));

  ReplayReport report;
  report.component = stage;
  report.has_past = fed.has_past();
  OutputComparison comparison(report);
  TickReader reader(recording, topics, range.last_tick);
  reader.let_end(topics & ~fed.needed_topics());
  const bool paced = range.rate > 0.0;
  TickClock clock(paced ? Pace::kScaled : Pace::kLockstep, paced ? range.rate : 1.0,
                  plan.graph.tick_s);
  const auto started_at = std::chrono::steady_clock::now();
  clock.start(started_at);
  std::uint64_t fed_ticks = 0;
  for (;; ++fed_ticks) {
    const auto recorded = reader.next();
    if (!recorded.ok()) return recorded.error();
    if (*recorded == nullptr) break;
    if (paced) std::this_thread::sleep_until(clock.due(fed_ticks));
    const auto stepped = fed.step(**recorded);
    if (!stepped.ok()) return core::Error{stepped.error().message, recording.path()};
    if (!*stepped) break;
    if (fed.stepped() && (*recorded)->tick() >= range.first_tick) {
      comparison.compare(fed, **recorded);
    }
  }
  if (report.ticks == 0) {
    return core::Error{
        fmt::format("has no tick from {} on; it has {}", range.first_tick, fed_ticks),
        recording.path()};
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started_at;
  report.ticks_per_s = static_cast<double>(fed_ticks) / took.count();
  return report;
}

namespace {

/// Feeds the component up to `last_tick`, and tells of each tick that was stepped.
template <typename OnStep>
Result<void> feed(const RunRecording& recording, const std::string& stage, FedNode& fed,
                  std::uint64_t last_tick, const OnStep& on_step) {
  CLEW_RETURN_IF_ERROR(check_recorded(recording, stage, fed.fed_topics()));
  TickReader reader(recording, fed.fed_topics(), last_tick);
  reader.let_end(fed.node().ports().delayed_inputs);
  for (;;) {
    const auto recorded = reader.next();
    if (!recorded.ok()) return recorded.error();
    if (*recorded == nullptr) return {};
    const auto stepped = fed.step(**recorded);
    if (!stepped.ok()) return core::Error{stepped.error().message, recording.path()};
    if (!*stepped) return {};
    on_step((*recorded)->tick());
  }
}

}  // namespace

Result<domain::Inside> inside_at(const RunRecording& recording, const runtime::RunPlan& plan,
                                 const std::string& stage, std::uint64_t tick) {
  auto fed = fed_node_of(recording, plan, stage);
  if (!fed.ok()) return fed.error();
  std::optional<std::uint64_t> last;
  CLEW_RETURN_IF_ERROR(
      feed(recording, stage, *fed, tick, [&](std::uint64_t stepped) { last = stepped; }));
  if (last != tick) return no_tick(recording, tick, last);
  return fed->inside();
}

Result<void> for_each_inside(
    const RunRecording& recording, const runtime::RunPlan& plan, const std::string& stage,
    const std::function<void(std::uint64_t tick, const domain::Inside& inside)>& visit) {
  auto fed = fed_node_of(recording, plan, stage);
  if (!fed.ok()) return fed.error();
  return feed(recording, stage, *fed, UINT64_MAX, [&](std::uint64_t tick) {
    if (fed->stepped()) visit(tick, fed->inside());
  });
}

}  // namespace clew::bridge
