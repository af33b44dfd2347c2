// SPDX-License-Identifier: Apache-2.0
#include "recording/run_recording.hpp"

#include <iterator>

#include "recording/begun_file.hpp"
#include "recording/piece_files.hpp"
#include "recording/recorded_incident.hpp"
#include "recording/recorded_intervention.hpp"
#include "recording/run_hash.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

/// Adds a sample to a topic's survey; false if it does not come after the last one.
bool add(RunSurvey::TopicSurvey& topic, const SampleView& sample) {
  if (topic.samples == 0) {
    topic.first_tick = sample.tick;
  } else {
    if (sample.tick <= topic.last_tick) return false;
    topic.missing_ticks += sample.tick - topic.last_tick - 1;
  }
  ++topic.samples;
  topic.last_tick = sample.tick;
  topic.chain.add(sample.tick, sample.sequence, sample.cdr);
  return true;
}

}  // namespace

core::Result<std::optional<SampleView>> SampleStream::next() {
  for (; !parts_.empty(); parts_.pop_front()) {
    const auto message = parts_.front().messages.next();
    if (!message.ok()) return message.error();
    if (!*message) continue;
    const mcap::Message& found = **message;
    SampleView sample{parts_.front().topics.at(found.channel_id),
                      ns_to_tick(found.log_time_ns, tick_s_), found.sequence, found.data};
    if (older_) CLEW_RETURN_IF_ERROR(bring_up_to_date(sample));
    return std::optional(sample);
  }
  return std::optional<SampleView>();
}

core::Result<void> SampleStream::bring_up_to_date(SampleView& sample) {
  const auto cdr = in_todays_type(sample.topic, sample.cdr);
  if (!cdr.ok()) {
    return core::Error{"tick " + std::to_string(sample.tick) + " of " +
                       std::string(domain::topic_name(sample.topic)) +
                       ", by the type that the recording gives: " + cdr.error().message};
  }
  sample.cdr = *cdr;
  return {};
}

core::Result<std::string_view> SampleStream::in_todays_type(domain::Topic topic,
                                                            std::string_view cdr) {
  const auto type = older_->find(topic);
  if (type == older_->end()) return cdr;
  if (!type->second.ok()) return type->second.error();
  return type->second->to_current(cdr, buffer_);
}

core::Result<RunRecording> RunRecording::open(const std::string& path) {
  auto recording = open_file(path);
  if (!recording.ok() || !recording->description_.split.any()) return recording;
  if (const std::uint64_t piece = recording->description_.piece; piece > 0) {
    return recording->error("is file " + std::to_string(piece + 1) +
                            " of a recording that is split: name its first file");
  }
  CLEW_RETURN_IF_ERROR(recording->open_later_files());
  return recording;
}

core::Result<void> RunRecording::open_later_files() {
  while (last_file().end_ && last_file().end_->continues) {
    const std::string next = existing_piece(path_, pieces());
    if (next.empty()) break;
    auto file = open_file(next);
    if (!file.ok()) {
      // One that is reserved only says nothing yet.
      const auto begun = is_only_begun(next);
      const bool growing = next != piece_path(path_, pieces());
      if (growing && begun.ok() && *begun) break;
      return file.error();
    }
    CLEW_RETURN_IF_ERROR(file->check_follows(last_file()));
    const auto append = [](auto& all, auto& more) {
      all.insert(all.end(), std::make_move_iterator(more.begin()),
                 std::make_move_iterator(more.end()));
    };
    append(interventions_, file->interventions_);
    append(incidents_, file->incidents_);
    later_.push_back(std::move(file).value());
  }
  const std::optional<RunEnd> end = last_file().end_;
  if (end && end->continues) missing_piece_ = piece_path(path_, pieces());
  end_ = end && !end->continues ? end : std::nullopt;
  return {};
}

core::Result<void> RunRecording::check_follows(const RunRecording& before) const {
  const std::uint64_t piece = before.description_.piece + 1;
  const bool follows = description_.split.any() && description_.piece == piece &&
                       description_.hash_before == before.end_->hash &&
                       description_.seed == before.description_.seed &&
                       description_.bundle == before.description_.bundle;
  if (follows) return {};
  return error("does not follow " + before.path_ + ": it is of another recording");
}

std::string RunRecording::unread_piece() const {
  return missing_piece_.empty() ? std::string() : next_existing_piece(path_, pieces() + 1);
}

core::Result<RunRecording> RunRecording::open_file(const std::string& path) {
  auto reader = mcap::McapReader::open(path);
  if (!reader.ok()) return reader.error();
  RunRecording recording(path, std::move(reader).value());
  CLEW_RETURN_IF_ERROR(recording.read_description());
  CLEW_RETURN_IF_ERROR(recording.read_attachments());
  CLEW_RETURN_IF_ERROR(recording.read_topics());
  CLEW_RETURN_IF_ERROR(recording.read_side_channels());
  return recording;
}

RunRecording::RunRecording(std::string path, mcap::McapReader reader)
    : path_(std::move(path)), reader_(std::move(reader)) {}

core::Result<void> RunRecording::read_description() {
  bool described = false;
  for (const auto& place : reader_.metadata()) {
    const auto metadata = reader_.metadata(place);
    if (!metadata.ok()) return metadata.error();
    if (metadata->name == kDescriptionName) {
      auto description = description_from_metadata(*metadata);
      if (!description.ok()) return error(description.error().message);
      description_ = std::move(description).value();
      described = true;
    } else if (metadata->name == kEndName) {
      const auto end = end_from_metadata(*metadata);
      if (!end.ok()) return error(end.error().message);
      end_ = *end;
    }
  }
  if (described) return {};
  if (tear()) return error("is cut off before it says which run it is of: it holds no ticks");
  return error("is no recording of a run: it has no metadata record '" +
               std::string(kDescriptionName) + "'");
}

core::Result<void> RunRecording::read_attachments() {
  constexpr std::string_view kState = kStatePrefix;
  mcap::ByteBuffer buffer;
  for (const auto& place : reader_.attachments()) {
    const auto attachment = reader_.attachment(place, buffer);
    if (!attachment.ok()) return attachment.error();
    const bool is_state = attachment->name.compare(0, kState.size(), kState) == 0;
    if (attachment->name.compare(0, kInterventionFiles.size(), kInterventionFiles) == 0) {
      intervention_files_[attachment->name.substr(kInterventionFiles.size())] =
          std::string(attachment->data);
    } else if (is_state && description_.black_box) {
      description_.black_box->states[attachment->name.substr(kState.size())] =
          std::string(attachment->data);
    } else {
      description_.bundle[attachment->name] = std::string(attachment->data);
    }
  }
  return {};
}

mcap::MessageFilter RunRecording::only(std::string_view topic) const {
  mcap::MessageFilter filter;
  filter.channels.emplace();
  for (const auto& [id, channel] : reader_.channels()) {
    if (channel.topic == topic) filter.channels->insert(id);
  }
  return filter;
}

template <typename Entry, typename FromJson>
core::Result<void> RunRecording::read_entries(std::string_view topic, const char* noun,
                                              const FromJson& from_json,
                                              std::vector<Entry>& entries) const {
  const mcap::MessageFilter filter = only(topic);
  if (filter.channels->empty()) return {};
  mcap::MessageStream messages = reader_.messages(mcap::Order::kFile, filter);
  for (;;) {
    const auto message = messages.next();
    if (!message.ok()) return message.error();
    if (!*message) return {};
    const std::uint64_t tick = ns_to_tick((*message)->log_time_ns, description_.tick_s);
    auto found = from_json(tick, (*message)->data);
    const bool in_order = entries.empty() || entries.back().tick <= tick;
    if (!found || !in_order) {
      return error(std::string("its ") + noun + " at tick " + std::to_string(tick) + " is not one");
    }
    entries.push_back(*std::move(found));
  }
}

core::Result<void> RunRecording::read_side_channels() {
  const auto with_files = [this](std::uint64_t tick, std::string_view json) {
    auto found = intervention_from_json(tick, json);
    if (!found) return found;
    const std::string prefix = std::to_string(tick) + '/';
    for (const auto& [name, text] : intervention_files_) {
      if (name.compare(0, prefix.size(), prefix) == 0) {
        found->files[name.substr(prefix.size())] = text;
      }
    }
    return found;
  };
  CLEW_RETURN_IF_ERROR(
      read_entries(kInterventionChannel, "intervention", with_files, interventions_));
  return read_entries(kIncidentChannel, "incident", incident_from_json, incidents_);
}

core::Result<void> RunRecording::read_topics() {
  auto older = std::make_shared<OlderTypes>();
  for (const auto& [id, channel] : reader_.channels()) {
    if (channel.topic.empty() || channel.topic.front() != '/') continue;
    const auto topic = domain::topic_from_name(channel.topic.substr(1));
    if (!topic) continue;
    const auto schema = reader_.schemas().find(channel.schema_id);
    if (channel.message_encoding != "cdr" || schema == reader_.schemas().end() ||
        schema->second.encoding != "omgidl" || schema->second.name != domain::type_name(*topic)) {
      return error("its channel " + channel.topic + " does not hold " +
                   std::string(domain::type_name(*topic)) + " as cdr with an omgidl schema");
    }
    if (!description_.schemas.emplace(*topic, schema->second.data).second) {
      return error("has two channels " + channel.topic);
    }
    if (schema->second.data != idl_text(*topic)) {
      older->emplace(*topic, OlderType::parse(*topic, schema->second.data));
    }
    topics_.emplace(id, *topic);
  }
  if (!older->empty()) older_ = std::move(older);
  return {};
}

bool RunRecording::has_field(domain::Topic topic, std::string_view path) const {
  if (!older_) return true;
  const auto type = older_->find(topic);
  return type == older_->end() || !type->second.ok() || type->second->has_field(path);
}

std::string RunRecording::cut_off() const {
  if (!missing_piece_.empty()) {
    const std::string unread = unread_piece();
    const std::string more = "; " + unread + " is there, but is not read: it comes later";
    return "lacks its next file, " + missing_piece_ + (unread.empty() ? std::string() : more);
  }
  if (!complete()) return "was cut off";
  if (end_->aborted.empty()) return {};
  return "is of a run that was aborted (" + end_->aborted + ')';
}

RunDescription RunRecording::description_of_samples() const {
  RunDescription description = description_;
  for (auto& [topic, schema] : description.schemas) schema = idl_text(topic);
  return description;
}

SampleStream::Part RunRecording::part(const std::set<domain::Topic>& wanted,
                                      mcap::MessageFilter filter) const {
  filter.channels.emplace();
  for (const auto& [channel_id, topic] : topics_) {
    if (wanted.empty() || wanted.count(topic) != 0) filter.channels->insert(channel_id);
  }
  return {reader_.messages(mcap::Order::kFile, filter), topics_};
}

SampleStream RunRecording::stream(const SampleFilter& filter,
                                  std::shared_ptr<const OlderTypes> older) const {
  mcap::MessageFilter messages;
  // Ticks beyond what a time in nanoseconds can tell are those up to the end.
  constexpr double kLast_ns = 9.2e18;
  const double tick_ns = description_.tick_s * 1e9;
  messages.first_ns = static_cast<double>(filter.first_tick) * tick_ns < kLast_ns
                          ? tick_to_ns(filter.first_tick, description_.tick_s)
                          : std::numeric_limits<std::uint64_t>::max();
  if (static_cast<double>(filter.last_tick) * tick_ns < kLast_ns) {
    messages.last_ns = tick_to_ns(filter.last_tick, description_.tick_s);
  }
  std::deque<SampleStream::Part> parts;
  parts.push_back(part(filter.topics, messages));
  for (const RunRecording& file : later_) parts.push_back(file.part(filter.topics, messages));
  return {std::move(parts), description_.tick_s, std::move(older)};
}

core::Result<RunSurvey> RunRecording::survey_samples() const {
  RunSurvey survey;
  // The hash is that of the bytes as they were written.
  SampleStream stream = raw_samples();
  std::optional<std::pair<std::uint64_t, domain::Topic>> last;
  for (;;) {
    const auto sample = stream.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) break;
    const std::pair<std::uint64_t, domain::Topic> place((*sample)->tick, (*sample)->topic);
    if ((last && place <= *last) || !add(survey.topics[(*sample)->topic], **sample)) {
      return error("its samples are not in the order of tick and topic at tick " +
                   std::to_string(place.first) + " of " +
                   std::string(domain::topic_name(place.second)));
    }
    last = place;
  }
  std::map<std::string, core::Hash128> chains;
  for (const auto& [topic, found] : survey.topics) {
    chains[std::string(domain::topic_name(topic))] = found.chain.value();
  }
  survey.hash = run_hash(chains);
  return survey;
}

core::Result<RunSurvey> RunRecording::survey() const {
  auto survey = survey_samples();
  if (survey.ok() && end_ && end_->hash != survey->hash) {
    return error("its samples have the hash " + survey->hash.hex() + ", its recorder wrote " +
                 end_->hash.hex());
  }
  return survey;
}

}  // namespace clew::bridge
