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
  explicit Past(std::vector<runtime::Node> nodes) {
    for (runtime::Node& node : nodes) fed_.emplace_back(std::move(node));
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

  void hand_over(ComposedStart& start) {
    for (FedNode& fed : fed_) start.nodes.push_back(fed.take());
    start.messages = std::move(messages_);
    start.journal = std::move(journal_);
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
  Codecs codecs_;
  domain::Messages messages_;
  Journal journal_{true, false};
};

Result<void> check_tick_duration(const RunRecording& recording, const runtime::RunPlan& plan) {
  const double recorded_s = recording.description().tick_s;
  if (plan.graph.tick_s == recorded_s) return {};
  return core::Error{fmt::format("has ticks of {} s; a branch cannot go on with ticks of {} s",
                                 recorded_s, plan.graph.tick_s),
                     recording.path(), 0, 0};
}

}  // namespace

Result<ComposedStart> branch_off(const RunRecording& recording, const runtime::RunPlan& plan,
                                 std::uint64_t tick) {
  ComposedStart start{{}, tick, {}, Journal(true, false), std::chrono::steady_clock::now()};
  CLEW_RETURN_IF_ERROR(check_tick_duration(recording, plan));
  auto nodes = runtime::make_nodes(plan);
  if (!nodes) return nodes.error();
  Past past(std::move(nodes).value());
  const auto refuse = [&](std::string what) {
    return core::Error{std::move(what), recording.path(), 0, 0};
  };
  if (tick > 0) {
    TickReader reader(recording, past.topics(), tick - 1);
    for (std::uint64_t next = 0; next < tick; ++next) {
      const auto recorded = reader.next();
      if (!recorded) return recorded.error();
      if (*recorded == nullptr) {
        return refuse(fmt::format("has {} ticks; a branch at tick {} needs as many", next, tick));
      }
      if (const auto added = past.add(**recorded); !added) return refuse(added.error().text());
    }
  }
  if (past.has_ended()) return refuse(fmt::format("the run ended at tick {}", tick - 1));
  past.hand_over(start);
  return start;
}

Result<std::optional<ReplayReport>> find_unfaithful(const RunRecording& recording,
                                                    const runtime::RunPlan& recorded,
                                                    std::uint64_t tick, const std::string& only) {
  const auto own = first_own_tick(recording);
  if (!own) return own.error();
  if (tick <= *own) return std::optional<ReplayReport>();
  ReplayRange range;
  range.first_tick = *own;
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
