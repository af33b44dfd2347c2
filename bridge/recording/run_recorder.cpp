// SPDX-License-Identifier: Apache-2.0
#include "recording/run_recorder.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "recording/run_hash.hpp"

namespace clew::bridge {
namespace {

constexpr std::uint64_t kChunkSpanNs = 1'000'000'000;

core::Error refused(domain::Topic topic, const std::string& why) {
  return {"topic " + std::string(domain::topic_name(topic)) + ": " + why, {}, 0, 0};
}

std::string library_of(const RunDescription& description) {
  const auto version = description.versions.find("clew");
  return version == description.versions.end() ? "clew" : "clew " + version->second;
}

}  // namespace

core::Result<RunRecorder> RunRecorder::create(const std::string& path,
                                              const RunDescription& description,
                                              const RecorderOptions& options) {
  mcap::WriterOptions writer_options;
  writer_options.library = library_of(description);
  writer_options.compression = options.compression;
  writer_options.chunk_span_ns = kChunkSpanNs;
  auto writer = mcap::McapWriter::create(path, options.overwrite, writer_options);
  if (!writer) return writer.error();
  CLEW_RETURN_IF_ERROR(writer->write(to_metadata(description)));
  for (const auto& [name, text] : description.bundle) {
    CLEW_RETURN_IF_ERROR(writer->write(mcap::Attachment{0, 0, name, "application/yaml", text}));
  }
  RunRecorder recorder(std::move(writer).value(), description.tick_s);
  recorder.declare_topics(description.schemas);
  return recorder;
}

RunRecorder::RunRecorder(mcap::McapWriter writer, double tick_s)
    : writer_(std::move(writer)), tick_s_(tick_s) {}

void RunRecorder::declare_topics(const std::map<domain::Topic, std::string>& schemas) {
  places_.fill(-1);
  // domain::Topic is in the order of the names.
  for (const auto& [topic, idl] : schemas) {
    RecordedTopic recorded;
    recorded.topic = topic;
    const auto schema = writer_.add_schema(std::string(domain::type_name(topic)), "omgidl", idl);
    recorded.channel_id =
        writer_.add_channel(schema, "/" + std::string(domain::topic_name(topic)), "cdr");
    places_[static_cast<std::size_t>(topic)] = static_cast<int>(topics_.size());
    topics_.push_back(std::move(recorded));
  }
}

core::Result<void> RunRecorder::check(const RecordedTopic& recorded, std::uint64_t tick,
                                      std::uint64_t sequence) const {
  if (recorded.last_tick && tick != *recorded.last_tick + 1) {
    return refused(recorded.topic, "tick " + std::to_string(tick) + " follows tick " +
                                       std::to_string(*recorded.last_tick));
  }
  if (!recorded.last_tick && first_tick_ && tick != *first_tick_) {
    return refused(recorded.topic, "begins at tick " + std::to_string(tick) +
                                       ", the recording at tick " + std::to_string(*first_tick_));
  }
  if (sequence > std::numeric_limits<std::uint32_t>::max()) {
    return refused(recorded.topic,
                   "sequence " + std::to_string(sequence) + " does not fit in 32 bits");
  }
  if (recorded.waiting.size() >= kMaxWaitingTicks) {
    return refused(recorded.topic,
                   "is " + std::to_string(kMaxWaitingTicks) + " ticks ahead of another topic");
  }
  return {};
}

core::Result<void> RunRecorder::add(domain::Topic topic, std::uint64_t tick, std::uint64_t sequence,
                                    std::string_view cdr) {
  const int place = places_[static_cast<std::size_t>(topic)];
  if (place < 0) return refused(topic, "is not part of this recording");
  RecordedTopic& recorded = topics_[static_cast<std::size_t>(place)];
  CLEW_RETURN_IF_ERROR(check(recorded, tick, sequence));
  if (!first_tick_) first_tick_ = tick;
  recorded.last_tick = tick;
  recorded.waiting.push({tick, sequence, cdr});
  while (every_topic_waits()) CLEW_RETURN_IF_ERROR(write_tick());
  return {};
}

bool RunRecorder::every_topic_waits() const {
  return std::none_of(topics_.begin(), topics_.end(),
                      [](const RecordedTopic& topic) { return topic.waiting.empty(); });
}

bool RunRecorder::any_topic_waits() const {
  return std::any_of(topics_.begin(), topics_.end(),
                     [](const RecordedTopic& topic) { return !topic.waiting.empty(); });
}

core::Result<void> RunRecorder::write_tick() {
  std::uint64_t tick = std::numeric_limits<std::uint64_t>::max();
  for (const RecordedTopic& topic : topics_) {
    if (!topic.waiting.empty()) tick = std::min(tick, topic.waiting.front().tick);
  }
  std::size_t written = 0;
  for (RecordedTopic& topic : topics_) {
    if (topic.waiting.empty() || topic.waiting.front().tick != tick) continue;
    CLEW_RETURN_IF_ERROR(write_front(topic));
    ++written;
  }
  if (written == topics_.size()) complete_ticks_ = tick + 1;
  return {};
}

core::Result<void> RunRecorder::write_front(RecordedTopic& topic) {
  const QueuedSample sample = topic.waiting.front();
  mcap::Message message;
  message.channel_id = topic.channel_id;
  message.sequence = static_cast<std::uint32_t>(sample.sequence);
  message.log_time_ns = tick_to_ns(sample.tick, tick_s_);
  message.publish_time_ns = message.log_time_ns;
  message.data = sample.cdr;
  CLEW_RETURN_IF_ERROR(writer_.write(message));
  topic.written = true;
  topic.chain.add(sample.tick, sample.sequence, sample.cdr);
  topic.waiting.pop();
  return {};
}

std::map<std::string, core::Hash128> RunRecorder::chains() const {
  std::map<std::string, core::Hash128> chains;
  for (const RecordedTopic& topic : topics_) {
    if (!topic.written) continue;
    chains[std::string(domain::topic_name(topic.topic))] = topic.chain.value();
  }
  return chains;
}

core::Result<void> RunRecorder::finish() {
  while (any_topic_waits()) CLEW_RETURN_IF_ERROR(write_tick());
  CLEW_RETURN_IF_ERROR(writer_.write(to_metadata(RunEnd{complete_ticks_, run_hash(chains())})));
  return writer_.finish();
}

}  // namespace clew::bridge
