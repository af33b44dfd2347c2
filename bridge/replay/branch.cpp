// SPDX-License-Identifier: Apache-2.0
#include "replay/branch.hpp"

#include <fmt/format.h>

#include <utility>

#include "replay/fed_node.hpp"
#include "replay/recorded_plan.hpp"

namespace clew::bridge {
namespace {

using core::Result;
using domain::Topic;

/// Makes the recorded ticks the past of a run that goes on.
class Past {
 public:
  /// `nodes` go on; but up to there the robot is the recorded one.
  Past(std::vector<runtime::Node> nodes, FedNode recorded_robot) {
    for (runtime::Node& node : nodes) {
      if (is_robot(node)) {
        fed_.push_back(std::move(recorded_robot));
        new_robot_ = std::move(node);
      } else {
        fed_.emplace_back(std::move(node));
      }
    }
  }

  runtime::TopicSet topics() const {
    runtime::TopicSet topics;
    for (const FedNode& fed : fed_) topics |= fed.fed_topics() | fed.node().ports().outputs;
    return topics;
  }

  Result<void> add(const RecordedTick& recorded) {
    if (recorded.present() != topics()) {
      return core::Error{fmt::format("lacks a sample of tick {}", recorded.tick()), {}, 0, 0};
    }
    for (FedNode& fed : fed_) CLEW_RETURN_IF_ERROR(fed.step(recorded));
    for (Topic topic : domain::kAllTopics) {
      if (recorded.has(topic)) CLEW_RETURN_IF_ERROR(account(topic, recorded));
    }
    return {};
  }

  bool has_ended() const {
    const auto& truth = journal_.tally().truth;
    return truth && truth->outcome != domain::Outcome::kRunning;
  }

  Result<void> hand_over(ComposedStart& start) {
    for (FedNode& fed : fed_) {
      if (is_robot(fed.node())) {
        CLEW_RETURN_IF_ERROR(new_robot_->load(fed.node().save()));
        start.nodes.push_back(std::move(*new_robot_));
      } else {
        start.nodes.push_back(fed.take());
      }
    }
    start.messages = std::move(messages_);
    start.journal = std::move(journal_);
    return {};
  }

 private:
  Result<void> account(Topic topic, const RecordedTick& recorded) {
    const auto decoded = domain::visit_topic(topic, [&](auto constant) {
      constexpr auto kIndex = static_cast<std::size_t>(decltype(constant)::value);
      auto& message = std::get<kIndex>(messages_);
      auto result = std::get<kIndex>(codecs_).decode(recorded.cdr(topic), message);
      if (result) journal_.add(message, recorded.cdr(topic));
      return result;
    });
    if (decoded) return {};
    return core::Error{
        fmt::format("tick {}: {}", recorded.tick(), decoded.error().message), {}, 0, 0};
  }

  std::vector<FedNode> fed_;
  std::optional<runtime::Node> new_robot_;
  Codecs codecs_;
  domain::Messages messages_;
  Journal journal_{true, false};
};

/// The robot as it was recorded.
Result<FedNode> recorded_robot(const RunRecording& recording, const runtime::RunPlan& recorded) {
  auto branch = branch_of(recording);
  if (!branch) return branch.error();
  auto node = runtime::make_node(recorded, *recorded.graph.writer_of(Topic::kState));
  if (!node) return node.error();
  return FedNode(std::move(node).value(), std::move(branch).value());
}

/// What can be said of a branch before any sample is read.
Result<void> check(const RunRecording& recording, const runtime::RunPlan& plan,
                   std::uint64_t tick) {
  const auto refuse = [&](std::string what) {
    return core::Error{std::move(what), recording.path(), 0, 0};
  };
  const double recorded_s = recording.description().tick_s;
  if (plan.graph.tick_s != recorded_s) {
    return refuse(fmt::format("has ticks of {} s; a branch cannot go on with ticks of {} s",
                              recorded_s, plan.graph.tick_s));
  }
  const auto branch = branch_of(recording);
  if (!branch) return branch.error();
  if (*branch && tick < (*branch)->tick) {
    return refuse(
        fmt::format("is a branch itself, at tick {}: what is before belongs to the "
                    "recording that it branched off",
                    (*branch)->tick));
  }
  return {};
}

}  // namespace

Result<ComposedStart> branch_off(const RunRecording& recording, const runtime::RunPlan& recorded,
                                 const runtime::RunPlan& plan, std::uint64_t tick) {
  ComposedStart start{{}, tick, {}, Journal(true, false), std::chrono::steady_clock::now()};
  CLEW_RETURN_IF_ERROR(check(recording, plan, tick));
  auto robot = recorded_robot(recording, recorded);
  if (!robot) return robot.error();
  auto nodes = runtime::make_nodes(plan);
  if (!nodes) return nodes.error();
  Past past(std::move(nodes).value(), std::move(robot).value());
  const auto refuse = [&](std::string what) {
    return core::Error{std::move(what), recording.path(), 0, 0};
  };
  if (tick > 0) {
    TickReader reader(recording, past.topics(), tick - 1);
    for (std::uint64_t next = 0; next < tick; ++next) {
      const auto found = reader.next();
      if (!found) return found.error();
      if (*found == nullptr) {
        return refuse(fmt::format("has {} ticks; a branch at tick {} needs as many", next, tick));
      }
      if (const auto added = past.add(**found); !added) return refuse(added.error().text());
    }
  }
  if (past.has_ended()) return refuse(fmt::format("the run ended at tick {}", tick - 1));
  CLEW_RETURN_IF_ERROR(past.hand_over(start));
  return start;
}

HandOver robot_of(const ComposedStart& start) {
  for (const runtime::Node& node : start.nodes) {
    if (is_robot(node)) return {start.next_tick, node.save()};
  }
  CLEW_CHECK(false, "a plan without drive");
}

Result<std::optional<ReplayReport>> find_unfaithful(const RunRecording& recording,
                                                    const runtime::RunPlan& recorded,
                                                    std::uint64_t tick, const std::string& only) {
  const auto branch = branch_of(recording);
  if (!branch) return branch.error();
  ReplayRange range;
  if (*branch) range.first_tick = (*branch)->tick;
  if (tick <= range.first_tick) return std::optional<ReplayReport>();
  range.last_tick = tick - 1;
  for (const auto& stage : recorded.graph.stages) {
    const std::string& name = stage.info->name;
    if (!stage.deployment.exec.empty() || (!only.empty() && name != only)) continue;
    auto report = replay_component(recording, recorded, name, range);
    if (!report) return report.error();
    if (!report->identical()) return std::optional<ReplayReport>(std::move(report).value());
  }
  return std::optional<ReplayReport>();
}

Result<void> copy_samples_before(const RunRecording& recording, std::uint64_t tick,
                                 SampleSink& sink) {
  if (tick == 0) return {};
  SampleFilter filter;
  filter.last_tick = tick - 1;
  SampleStream stream = recording.samples(filter);
  for (;;) {
    const auto sample = stream.next();
    if (!sample) return sample.error();
    if (!*sample) return {};
    const RecordedSample& found = **sample;
    CLEW_RETURN_IF_ERROR(sink.add({found.topic, found.tick, found.sequence, found.cdr}));
  }
}

}  // namespace clew::bridge
