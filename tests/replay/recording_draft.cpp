// SPDX-License-Identifier: Apache-2.0
#include "recording_draft.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "recorded_run.hpp"
#include "recording/mcap_writer.hpp"
#include "recording/run_hash.hpp"

namespace clew::replay_test {

using namespace bridge;

RecordingDraft RecordingDraft::read(const std::string& path) {
  const RunRecording recording = open_recording(path);
  RecordingDraft draft;
  draft.description = recording.description();
  SampleStream stream = recording.samples();
  for (auto sample = stream.next(); sample.ok() && *sample; sample = stream.next()) {
    const SampleView& found = **sample;
    draft.samples.push_back({found.topic, found.tick, found.sequence, std::string(found.cdr)});
  }
  return draft;
}

void RecordingDraft::write(const std::string& path) const {
  auto writer = mcap::McapWriter::create(path, true, {});
  ASSERT_TRUE(writer.ok() && writer->write(to_metadata(description)).ok());
  for (const auto& [name, text] : description.bundle) {
    ASSERT_TRUE(writer->write(mcap::Attachment{0, 0, name, "application/yaml", text}).ok());
  }
  std::map<domain::Topic, std::uint16_t> channels;
  for (const auto& [topic, idl] : description.schemas) {
    const auto schema = writer->add_schema(std::string(domain::type_name(topic)), "omgidl", idl);
    channels[topic] =
        writer->add_channel(schema, "/" + std::string(domain::topic_name(topic)), "cdr");
  }
  std::map<domain::Topic, core::HashChain> chains;
  for (const Sample& sample : samples) {
    const std::uint64_t time_ns = tick_to_ns(sample.tick, description.tick_s);
    ASSERT_TRUE(writer
                    ->write(mcap::Message{channels.at(sample.topic),
                                          static_cast<std::uint32_t>(sample.sequence), time_ns,
                                          time_ns, sample.cdr})
                    .ok());
    chains[sample.topic].add(sample.tick, sample.sequence, sample.cdr);
  }
  std::map<std::string, core::Hash128> values;
  for (const auto& [topic, chain] : chains) {
    values[std::string(domain::topic_name(topic))] = chain.value();
  }
  const std::uint64_t ticks = samples.empty() ? 0 : samples.back().tick + 1;
  if (finished) {
    ASSERT_TRUE(writer->write(to_metadata(RunEnd{ticks, run_hash(values), 0, aborted})).ok());
  }
  ASSERT_TRUE(writer->finish().ok());
}

RecordingDraft::Sample& RecordingDraft::sample(domain::Topic topic, std::uint64_t tick) {
  const auto found = std::find_if(samples.begin(), samples.end(), [&](const Sample& candidate) {
    return candidate.topic == topic && candidate.tick == tick;
  });
  CLEW_CHECK(found != samples.end(), "no such sample in the draft");
  return *found;
}

void RecordingDraft::drop(domain::Topic topic, std::uint64_t first_tick, std::uint64_t last_tick) {
  const auto dropped = [&](const Sample& sample) {
    return sample.topic == topic && sample.tick >= first_tick && sample.tick <= last_tick;
  };
  samples.erase(std::remove_if(samples.begin(), samples.end(), dropped), samples.end());
}

}  // namespace clew::replay_test
