// SPDX-License-Identifier: Apache-2.0
#include "replay/live_checks.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/nearest_name.hpp"
#include "replay/black_box_past.hpp"
#include "replay/recorded_plan.hpp"
#include "replay/tick_reader.hpp"
#include "run/sample_account.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;
using domain::Topic;

/// Drive is given each command when it is due, in lockstep; and its state begins at tick 0.
Result<void> check_drive(const RunRecording& recording, std::uint64_t last_tick) {
  const auto branch = branch_of(recording);
  if (!branch.ok()) return branch.error();
  if (*branch) {
    return Error{fmt::format("branched off at tick {}, where drive took over another run's state: "
                             "replay drive without --publish",
                             (*branch)->tick),
                 recording.path()};
  }
  runtime::TopicSet topics;
  topics.set(index_of(Topic::kState));
  TickReader reader(recording, topics, last_tick);
  Codec<domain::State> codec;
  domain::State state;
  while (true) {
    const auto tick = reader.next();
    if (!tick.ok()) return tick.error();
    if (*tick == nullptr) return {};
    if (const auto decoded = codec.decode((*tick)->cdr(Topic::kState), state); !decoded.ok()) {
      return Error{decoded.error().message, recording.path()};
    }
    if (!state.command_late) continue;
    return Error{fmt::format("the command of tick {} was late, in real time: replay drive without "
                             "--publish",
                             (*tick)->tick()),
                 recording.path()};
  }
}

}  // namespace

Result<Topic> recorded_topic(const RunRecording& recording, const std::string& name) {
  const std::string plain = name.substr(name.find('/') == 0 ? 1 : 0);
  std::vector<std::string> known;
  for (const auto& [topic, schema] : recording.description().schemas) {
    if (domain::topic_name(topic) == plain) return topic;
    known.emplace_back(domain::topic_name(topic));
  }
  return Error{core::unknown_name("topic of this recording", plain, known), recording.path()};
}

Result<void> check_fed(const RunRecording& recording, const runtime::GraphStage& stage,
                       const runtime::TopicSet& topics, std::uint64_t last_tick) {
  const std::string& name = stage.info->name;
  for (Topic topic : domain::kAllTopics) {
    const auto index = index_of(topic);
    if (stage.ports.outputs[index] && topics[index]) {
      return Error{fmt::format("{} writes '{}' itself", name, domain::topic_name(topic))};
    }
    if (stage.ports.all_inputs()[index] && !topics[index]) {
      return Error{
          fmt::format("'{}', which {} needs, is not published", domain::topic_name(topic), name)};
    }
  }
  CLEW_RETURN_IF_ERROR(
      check_recorded(recording, name, stage.ports.all_inputs() | stage.ports.outputs));
  if (stage.ports.delayed_inputs.none()) return {};
  return check_drive(recording, last_tick);
}

Result<void> check_live(const RunRecording& recording, const runtime::RunPlan& plan,
                        const LiveReplayOptions& options) {
  CLEW_RETURN_IF_ERROR(check_range(options.range));
  if (options.range.last_tick != ReplayRange{}.last_tick) {
    CLEW_RETURN_IF_ERROR(check_last_tick(recording, options.range.last_tick));
  }
  if (options.component.empty()) {
    if (options.topics.any()) return {};
    return Error{"nothing to publish: name topics, or a stage with --component"};
  }
  if (options.loops) return Error{"a component's ticks only go on: leave out --loop"};
  const auto stage = find_stage(plan, options.component);
  if (!stage.ok()) return stage.error();
  for (const auto& [topic, name] : options.names) {
    if (!(*stage)->ports.all_inputs()[index_of(topic)]) continue;
    return Error{fmt::format("{} reads '{}' under its own name: leave out --remap {}",
                             options.component, domain::topic_name(topic),
                             domain::topic_name(topic))};
  }
  CLEW_RETURN_IF_ERROR(refuse_black_box(
      recording, "a live component begins at tick 0; replay it without --publish"));
  return check_fed(recording, **stage, options.topics | (*stage)->ports.all_inputs(),
                   options.range.last_tick);
}

Error no_tick_from(const RunRecording& recording, std::uint64_t first_tick) {
  return {fmt::format("has no tick from {} on", first_tick), recording.path()};
}

}  // namespace clew::bridge
