// SPDX-License-Identifier: Apache-2.0
#include "recording/run_recorder.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <tuple>
#include <utility>

#include "recording/begun_file.hpp"
#include "recording/piece_files.hpp"
#include "recording/run_hash.hpp"
#include "recording/run_recording.hpp"

namespace clew::bridge {
namespace {

constexpr std::uint64_t kChunkSpan_ns = 1'000'000'000;

// In the place of a topic among those that are written.
constexpr int kOfNoRun = -1;
constexpr int kLeftOut = -2;

/// As rosbag2 tells of a writer's QoS. Every writer of a run offers this, on either vendor; the
/// history is as deep as processes have it.
constexpr const char* kOfferedQos =
    "- history: keep_last\n  depth: 512\n  reliability: reliable\n  durability: transient_local\n"
    "  deadline: {sec: 9223372036, nsec: 854775807}\n"
    "  lifespan: {sec: 9223372036, nsec: 854775807}\n  liveliness: automatic\n"
    "  liveliness_lease_duration: {sec: 9223372036, nsec: 854775807}\n"
    "  avoid_ros_namespace_conventions: true\n";

core::Error refused(domain::Topic topic, const std::string& why) {
  return {"topic " + std::string(domain::topic_name(topic)) + ": " + why};
}

std::string library_of(const RunDescription& description) {
  const auto version = description.versions.find("clew");
  return version == description.versions.end() ? "clew" : "clew " + version->second;
}

}  // namespace

core::Result<bool> RunRecorder::holds_samples(const std::string& file) {
  std::error_code code;
  if (!std::filesystem::exists(file, code) && !code) return false;
  const auto recording = RunRecording::open_file(file);
  if (!recording.ok()) {
    const auto begun = is_only_begun(file);
    if (!begun.ok()) return begun.error();
    if (*begun) return false;
    return recording.error();
  }
  const auto sample = recording->raw_samples().next();
  if (!sample.ok()) return sample.error();
  return sample->has_value();
}

core::Result<RunRecorder> RunRecorder::create(const std::string& path,
                                              const RunDescription& description, bool overwrite) {
  auto file = mcap::OutputFile::create(path, overwrite);
  if (!file.ok()) return file.error();
  auto recorder = start(std::move(file).value(), description);
  if (recorder.ok()) recorder->overwrite_ = overwrite;
  return recorder;
}

core::Result<void> RunRecorder::describe(const std::string& path,
                                         const RunDescription& description) {
  auto file = mcap::OutputFile::go_on(path);
  if (!file.ok()) return file.error();
  const auto begun = start(std::move(file).value(), description);
  if (!begun.ok()) return begun.error();
  return {};
}

core::Result<RunRecorder> RunRecorder::go_on(const std::string& path,
                                             const RunDescription& description,
                                             std::uint64_t least_ticks, bool overwrite) {
  const auto too_short = [&](std::uint64_t ticks) {
    return core::Error{"holds " + std::to_string(ticks) + " ticks of the " +
                           std::to_string(least_ticks) + " that were written to it",
                       mcap::OutputFile::temporary_name(path)};
  };
  const std::string there = mcap::OutputFile::temporary_name(path);
  auto file = mcap::OutputFile::go_on(path);
  if (!file.ok()) return file.error();
  const auto holds = holds_samples(there);
  if (!holds.ok()) return holds.error();
  // What is written first empties a file without samples.
  if (!*holds && least_ticks > 0) return too_short(0);
  if (*holds) file->keep(true);
  auto recorder = start(std::move(file).value(), description);
  if (!recorder.ok()) return recorder.error();
  recorder->overwrite_ = overwrite;
  recorder->went_on_ = true;
  if (*holds) CLEW_RETURN_IF_ERROR(recorder->keep(there));
  std::uint64_t kept_ticks = 0;
  for (const RecordedTopic& topic : recorder->topics_) {
    kept_ticks = std::max(kept_ticks, topic.next_tick);
  }
  if (kept_ticks < least_ticks) return too_short(kept_ticks);
  return recorder;
}

core::Result<RunRecorder> RunRecorder::start(mcap::OutputFile file,
                                             const RunDescription& description) {
  const std::string path = file.path();
  auto writer = begin_file(std::move(file), description);
  if (!writer.ok()) return writer.error();
  RunRecorder recorder(std::move(writer).value(), path, description);
  recorder.declare_topics();
  return recorder;
}

core::Result<mcap::McapWriter> RunRecorder::begin_file(mcap::OutputFile file,
                                                       const RunDescription& description) {
  mcap::WriterOptions writer_options;
  writer_options.library = library_of(description);
  writer_options.compression = description.compression;
  writer_options.chunk_span_ns = kChunkSpan_ns;
  // A run that dies now leaves a file that says which run it is of, or an empty one.
  file.hold();
  auto writer = mcap::McapWriter::create(std::move(file), writer_options);
  if (!writer.ok()) return writer.error();
  CLEW_RETURN_IF_ERROR(writer->write(to_metadata(description)));
  for (const auto& [name, text] : description.bundle) {
    CLEW_RETURN_IF_ERROR(writer->write(mcap::Attachment{0, 0, name, "application/yaml", text}));
  }
  if (const auto& box = description.black_box) {
    for (const auto& [stage, state] : box->states) {
      CLEW_RETURN_IF_ERROR(writer->write(
          mcap::Attachment{0, 0, kStatePrefix + stage, "application/octet-stream", state}));
    }
  }
  CLEW_RETURN_IF_ERROR(writer->release());
  return writer;
}

// What is there is written once more, by a writer that only compares: so all its state is that of
// the recorder that was cut off.
core::Result<void> RunRecorder::keep(const std::string& file) {
  const auto recording = RunRecording::open(file);
  if (!recording.ok()) return recording.error();
  keeps_ = true;
  for (const domain::Intervention& found : recording->interventions()) add_intervention(found);
  for (const domain::Incident& found : recording->incidents()) add_incident(found);
  SampleStream stream = recording->raw_samples();
  for (;;) {
    const auto sample = stream.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) break;
    const SampleView& found = **sample;
    CLEW_RETURN_IF_ERROR(add(found.topic, found.tick, found.sequence, found.cdr));
  }
  keeps_ = false;
  writer_.keep(false);
  return {};
}

RunRecorder::RunRecorder(mcap::McapWriter writer, std::string path,
                         const RunDescription& description)
    : writer_(std::move(writer)),
      path_(std::move(path)),
      description_(description),
      tick_s_(description.tick_s) {
  places_.fill(kOfNoRun);
  for (const domain::Topic topic : description.left_out) places_[index_of(topic)] = kLeftOut;
  for (const auto& [topic, idl] : description.schemas) {
    places_[index_of(topic)] = static_cast<int>(topics_.size());
    topics_.emplace_back();
    topics_.back().topic = topic;
  }
}

void RunRecorder::declare_topics() {
  // domain::Topic is in the order of the names.
  for (RecordedTopic& recorded : topics_) {
    const auto schema = writer_.add_schema(std::string(domain::type_name(recorded.topic)), "omgidl",
                                           description_.schemas.at(recorded.topic));
    recorded.channel_id =
        writer_.add_channel(schema, "/" + std::string(domain::topic_name(recorded.topic)), "cdr",
                            {{"offered_qos_profiles", kOfferedQos}});
  }
  beginning_bytes_ = writer_.size_bytes();
}

bool RunRecorder::piece_is_full(std::uint64_t next_tick) const {
  const RecordingSplit& split = description_.split;
  if (!split.any() || !piece_tick_ || next_tick <= *piece_tick_) return false;
  if (description_.piece + 1 >= kMaxPieces) return false;
  // What every file repeats does not count: a bundle alone may be larger than a file is to be.
  if (split.bytes > 0 && writer_.size_bytes() >= beginning_bytes_ + split.bytes) return true;
  if (!(split.seconds > 0.0)) return false;
  const auto interval = [&](std::uint64_t tick) {
    return tick_to_ns(tick, tick_s_) / tick_to_ns(1, split.seconds);
  };
  return interval(next_tick) > interval(*piece_tick_);
}

// The first file's name says that all of the recording is there.
core::Result<void> RunRecorder::close_piece() {
  RunEnd end{complete_ticks_, run_hash(chains()), losses_.samples(), {}};
  end.continues = true;
  description_.hash_before = end.hash;
  CLEW_RETURN_IF_ERROR(writer_.write(to_metadata(end)));
  if (description_.piece > 0) return writer_.finish(overwrite_);
  // Nobody else may take the recording for one that was left.
  auto lock = writer_.share_lock();
  if (!lock.ok()) return lock.error();
  first_file_ = std::move(lock).value();
  return writer_.seal();
}

core::Result<void> RunRecorder::open_next_piece(std::uint64_t first_tick) {
  ++description_.piece;
  const std::string path = piece_path(path_, description_.piece);
  auto file = keeps_ ? kept_piece(path) : new_piece(path, overwrite_, overwrite_ || went_on_);
  if (!file.ok()) return file.error();
  auto writer = begin_file(std::move(file).value(), description_);
  if (!writer.ok()) return writer.error();
  writer_ = std::move(writer).value();
  declare_topics();
  interventions_.begin_file();
  incidents_.begin_file();
  piece_tick_ = first_tick;
  // What the files before this one hold outlives this process.
  durable_ticks_ = first_tick;
  return {};
}

core::Result<void> RunRecorder::add(domain::Topic topic, std::uint64_t tick, std::uint64_t sequence,
                                    std::string_view cdr) {
  const int place = places_[index_of(topic)];
  if (place == kLeftOut) return {};
  if (place == kOfNoRun) return refused(topic, "is not part of this recording");
  RecordedTopic& recorded = topics_[static_cast<std::size_t>(place)];
  if (tick < recorded.next_tick || (next_tick_ && tick < *next_tick_)) return {};
  if (sequence > std::numeric_limits<std::uint32_t>::max()) {
    return refused(topic, "sequence " + std::to_string(sequence) + " does not fit in 32 bits");
  }
  note_sequence(recorded, tick, sequence);
  recorded.next_tick = tick + 1;
  recorded.waiting.push({topic, tick, sequence, cdr});
  while (every_topic_waits() || recorded.waiting.size() > kMaxWaitingTicks) {
    CLEW_RETURN_IF_ERROR(write_tick());
  }
  return {};
}

// Ticks without a sample are noted when they are written; here, numbers that belong to no tick.
void RunRecorder::note_sequence(RecordedTopic& recorded, std::uint64_t tick,
                                std::uint64_t sequence) {
  if (recorded.next_sequence) {
    const std::uint64_t expected = *recorded.next_sequence + (tick - recorded.next_tick);
    if (sequence > expected) losses_.add_sequences(recorded.topic, tick, sequence - expected);
  }
  recorded.next_sequence = sequence + 1;
}

bool RunRecorder::every_topic_waits() const {
  return std::none_of(topics_.begin(), topics_.end(),
                      [](const RecordedTopic& topic) { return topic.waiting.empty(); });
}

bool RunRecorder::any_topic_waits() const {
  return std::any_of(topics_.begin(), topics_.end(),
                     [](const RecordedTopic& topic) { return !topic.waiting.empty(); });
}

// Topics may end before others in a run that was aborted: nothing more of them will come.
core::Result<void> RunRecorder::write_tick(bool topics_may_end) {
  std::uint64_t tick = std::numeric_limits<std::uint64_t>::max();
  for (const RecordedTopic& topic : topics_) {
    if (!topic.waiting.empty()) tick = std::min(tick, topic.waiting.front().tick);
  }
  if (piece_is_full(tick)) {
    CLEW_RETURN_IF_ERROR(close_piece());
    CLEW_RETURN_IF_ERROR(open_next_piece(tick));
  }
  if (!piece_tick_) piece_tick_ = tick;
  CLEW_RETURN_IF_ERROR(write_side_channels(tick));
  const std::uint64_t first = next_tick_.value_or(tick);
  std::size_t written = 0;
  for (RecordedTopic& topic : topics_) {
    const bool there = !topic.waiting.empty() && topic.waiting.front().tick == tick;
    const bool ended = topics_may_end && topic.waiting.empty();
    const std::uint64_t missing = ended ? 0 : tick - first + (there ? 0 : 1);
    if (missing > 0) losses_.add_ticks(topic.topic, first, first + missing - 1);
    if (!there) continue;
    CLEW_RETURN_IF_ERROR(write_front(topic));
    ++written;
  }
  next_tick_ = tick + 1;
  if (written == topics_.size()) complete_ticks_ = tick + 1;
  return {};
}

void RunRecorder::add_intervention(const domain::Intervention& added) {
  const std::string text = to_planned_json(added);
  for (const domain::Intervention& known : interventions_.entries()) {
    if (to_planned_json(known) == text) return;
  }
  domain::Intervention intervention = added;
  // An order changes nothing: in real time it may come when its tick is written.
  if (!added.order.empty()) intervention.tick = std::max(added.tick, next_tick_.value_or(0));
  interventions_.insert(std::move(intervention));
}

void RunRecorder::add_incident(domain::Incident incident) {
  for (const domain::Incident& known : incidents_.entries()) {
    const bool same = std::tie(known.kind, known.stage, known.text) ==
                      std::tie(incident.kind, incident.stage, incident.text);
    if (same) return;
  }
  incident.tick = std::max(incident.tick, next_tick_.value_or(0));
  incidents_.insert(std::move(incident));
}

core::Result<void> RunRecorder::write_side_channels(std::uint64_t tick) {
  const auto write_files = [this](const domain::Intervention& intervention) -> core::Result<void> {
    const std::string folder =
        std::string(kInterventionFiles) + std::to_string(intervention.tick) + '/';
    for (const auto& [name, text] : intervention.files) {
      CLEW_RETURN_IF_ERROR(
          writer_.write(mcap::Attachment{0, 0, folder + name, "application/octet-stream", text}));
    }
    return {};
  };
  CLEW_RETURN_IF_ERROR(interventions_.write_until(tick, tick_s_, writer_, write_files));
  return incidents_.write_until(tick, tick_s_, writer_);
}

core::Result<void> RunRecorder::write_front(RecordedTopic& topic) {
  const SampleView sample = topic.waiting.front();
  mcap::Message message;
  message.channel_id = topic.channel_id;
  message.sequence = static_cast<std::uint32_t>(sample.sequence);
  message.log_time_ns = tick_to_ns(sample.tick, tick_s_);
  message.publish_time_ns = message.log_time_ns;
  message.data = sample.cdr;
  const std::uint64_t chunks = writer_.chunk_count();
  CLEW_RETURN_IF_ERROR(writer_.write(message));
  if (writer_.chunk_count() > chunks) durable_ticks_ = sample.tick;
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

core::Result<void> RunRecorder::write_ending(const std::string& aborted,
                                             const std::optional<core::Hash128>& run_hash_of_all) {
  while (any_topic_waits()) CLEW_RETURN_IF_ERROR(write_tick(!aborted.empty()));
  // What was told since the last tick; its time is that of the tick that did not come.
  incidents_.move_unwritten_to(next_tick_.value_or(0));
  CLEW_RETURN_IF_ERROR(incidents_.write_until(next_tick_.value_or(0), tick_s_, writer_));
  RunEnd end{complete_ticks_, run_hash(chains()), losses_.samples(), aborted};
  if (!description_.left_out.empty()) end.run_hash = run_hash_of_all;
  return writer_.write(to_metadata(end));
}

core::Result<void> RunRecorder::seal(const std::string& aborted,
                                     const std::optional<core::Hash128>& run_hash) {
  CLEW_RETURN_IF_ERROR(write_ending(aborted, run_hash));
  // Of a recording that is split, only the first file's name is someone else's to give.
  return description_.piece == 0 ? writer_.seal() : writer_.finish(overwrite_);
}

core::Result<void> RunRecorder::finish(const std::string& aborted,
                                       const std::optional<core::Hash128>& run_hash) {
  CLEW_RETURN_IF_ERROR(write_ending(aborted, run_hash));
  CLEW_RETURN_IF_ERROR(writer_.finish(description_.piece == 0 || overwrite_));
  return description_.piece == 0 ? core::Result<void>() : mcap::OutputFile::give_name(path_);
}

}  // namespace clew::bridge
