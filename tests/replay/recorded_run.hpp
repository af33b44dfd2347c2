// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "recording/run_recording.hpp"
#include "runtime/run_plan.hpp"
#include "wire/codec.hpp"

namespace clew::replay_test {

/// configs/ of the source tree.
const runtime::ConfigPath& shipped_configs();

/// The plan of a shipped graph; a failure of the test if it is refused.
runtime::RunPlan plan_of(const std::string& graph, const runtime::GraphOverrides& overrides = {});

/// Overrides of behaviours, of values, and an end after `max_ticks`.
runtime::GraphOverrides changes(std::vector<std::string> with, std::vector<std::string> set = {},
                                std::uint64_t max_ticks = 20000);
/// The same in another world.
runtime::GraphOverrides in_world(const std::string& world, std::uint64_t max_ticks = 20000);

/// Runs a plan composed, to its end, and records it.
void record_run(const runtime::RunPlan& plan, const std::string& path);

bridge::RunRecording open_recording(const std::string& path);

/// The plan of a recording, with changes.
runtime::RunPlan replay_plan(const bridge::RunRecording& recording,
                             const runtime::GraphOverrides& overrides = {});

/// Every recorded message of a type, in order of ticks.
template <typename Message>
std::vector<Message> messages_of(const bridge::RunRecording& recording) {
  bridge::SampleFilter filter;
  filter.topics = {domain::topic_of<Message>()};
  bridge::SampleStream stream = recording.samples(filter);
  bridge::Codec<Message> codec;
  std::vector<Message> messages;
  for (auto sample = stream.next(); sample.ok() && *sample; sample = stream.next()) {
    const auto decoded = codec.decode((*sample)->cdr, messages.emplace_back());
    CLEW_CHECK(decoded.ok(), decoded.error().text());
  }
  return messages;
}

}  // namespace clew::replay_test
