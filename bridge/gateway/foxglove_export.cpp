// SPDX-License-Identifier: Apache-2.0
#include "gateway/foxglove_export.hpp"

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "gateway/foxglove_scene.hpp"
#include "recording/mcap_writer.hpp"

namespace clew::bridge {
namespace {

using core::Result;

/// Writes tick by tick.
class FoxgloveExport {
 public:
  FoxgloveExport(mcap::McapWriter& writer, FoxgloveScene scene, const RunDescription& description)
      : writer_(writer), scene_(std::move(scene)), tick_s_(description.tick_s) {
    for (const auto& [topic, idl] : description.schemas) {
      const auto schema = writer_.add_schema(std::string(domain::type_name(topic)), "omgidl", idl);
      channels_[topic] =
          writer_.add_channel(schema, '/' + std::string(domain::topic_name(topic)), "cdr");
    }
    for (const FoxgloveChannel& channel : foxglove_channels()) {
      const auto schema = writer_.add_schema(channel.schema_name, "jsonschema", channel.schema);
      scene_channels_.push_back(writer_.add_channel(schema, channel.topic, "json"));
    }
  }

  Result<void> add(const SampleView& sample) {
    if (!tick_.empty() && tick_.front().tick != sample.tick) CLEW_RETURN_IF_ERROR(end_tick());
    tick_.push_back({sample.topic, sample.tick, sample.sequence, std::string(sample.cdr)});
    return {};
  }

  Result<void> end_tick() {
    if (tick_.empty()) return {};
    const std::uint64_t time_ns = tick_to_ns(tick_.front().tick, tick_s_);
    const auto sequence = static_cast<std::uint32_t>(tick_.front().tick);
    std::vector<SampleView> samples;
    for (const Held& held : tick_) {
      samples.push_back({held.topic, held.tick, held.sequence, held.cdr});
      CLEW_RETURN_IF_ERROR(writer_.write(mcap::Message{channels_.at(held.topic),
                                                       static_cast<std::uint32_t>(held.sequence),
                                                       time_ns, time_ns, held.cdr}));
    }
    for (const FoxgloveMessage& message : scene_.convert(time_ns, samples)) {
      const auto channel = scene_channels_[static_cast<std::size_t>(message.topic)];
      CLEW_RETURN_IF_ERROR(
          writer_.write(mcap::Message{channel, sequence, time_ns, time_ns, message.json}));
    }
    tick_.clear();
    return {};
  }

 private:
  struct Held {
    domain::Topic topic;
    std::uint64_t tick;
    std::uint64_t sequence;
    std::string cdr;
  };

  mcap::McapWriter& writer_;
  FoxgloveScene scene_;
  double tick_s_;
  std::map<domain::Topic, std::uint16_t> channels_;
  std::vector<std::uint16_t> scene_channels_;
  std::vector<Held> tick_;
};

}  // namespace

Result<void> export_foxglove(const RunRecording& recording, const std::string& path,
                             bool overwrite) {
  auto scene = FoxgloveScene::create(recording.description());
  if (!scene.ok()) return core::Error{scene.error().text(), recording.path()};
  scene->take_changes(recording.interventions());
  mcap::WriterOptions options;
  options.library = "clew";
  options.compression = mcap::Compression::kZstd;
  auto writer = mcap::McapWriter::create(path, overwrite, options);
  if (!writer.ok()) return writer.error();
  FoxgloveExport exported(*writer, std::move(scene).value(), recording.description_of_samples());
  SampleStream samples = recording.samples();
  while (true) {
    const auto sample = samples.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) break;
    CLEW_RETURN_IF_ERROR(exported.add(**sample));
  }
  CLEW_RETURN_IF_ERROR(exported.end_tick());
  return writer->finish();
}

}  // namespace clew::bridge
