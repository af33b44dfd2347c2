// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/hash128.hpp"
#include "core/result.hpp"
#include "domain/incident.hpp"
#include "domain/intervention.hpp"
#include "domain/topics.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/run_description.hpp"
#include "wire/older_type.hpp"
#include "wire/sample.hpp"

namespace clew::bridge {

struct SampleFilter {
  std::set<domain::Topic> topics;  ///< empty: all
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = std::numeric_limits<std::uint64_t>::max();
};

/// The types of topics that were others when a recording was made.
using OlderTypes = std::map<domain::Topic, core::Result<OlderType>>;

/// Reads the samples of a recording in canonical order: tick, topic, sequence.
class SampleStream {
 public:
  /// The messages of one file, and its topics by channel.
  struct Part {
    mcap::MessageStream messages;
    std::map<std::uint16_t, domain::Topic> topics;
  };

  /// The files one after another.
  SampleStream(std::deque<Part> parts, double tick_s, std::shared_ptr<const OlderTypes> older)
      : parts_(std::move(parts)), tick_s_(tick_s), older_(std::move(older)) {}

  /// The next sample, valid until the next call; nothing at the end. An error, a changed byte, a
  /// failing disk, or a sample that is not of its recorded type, ends the stream.
  core::Result<std::optional<SampleView>> next();

 private:
  core::Result<void> bring_up_to_date(SampleView& sample);
  core::Result<std::string_view> in_todays_type(domain::Topic topic, std::string_view cdr);

  std::deque<Part> parts_;  ///< that are not at their end; the first is read
  double tick_s_;
  std::shared_ptr<const OlderTypes> older_;  ///< null: samples are given as they are
  std::vector<char> buffer_;                 ///< of a sample in today's type
};

/// What all samples of a recording together say.
struct RunSurvey {
  struct TopicSurvey {
    std::uint64_t samples = 0;
    std::uint64_t first_tick = 0;
    std::uint64_t last_tick = 0;
    std::uint64_t missing_ticks = 0;  ///< between first and last, without a sample
    core::HashChain chain;
  };
  std::map<domain::Topic, TopicSurvey> topics;  ///< with a sample at least
  core::Hash128 hash;                           ///< run_hash of them
};

/// The recording of a run, opened for reading. A file that was cut off opens up to the tear. One
/// that is split is named by its first file, and read as one.
class RunRecording {
 public:
  /// Refused: what mcap::McapReader refuses, files that are no recording of a run, and one whose
  /// description was changed.
  static core::Result<RunRecording> open(const std::string& path);
  /// One file alone, whatever it is part of.
  static core::Result<RunRecording> open_file(const std::string& path);

  const std::string& path() const { return path_; }
  const RunDescription& description() const { return description_; }
  /// What was changed while the run went on, in the order of the ticks.
  const std::vector<domain::Intervention>& interventions() const { return interventions_; }
  /// What befell the run, in the order of the ticks.
  const std::vector<domain::Incident>& incidents() const { return incidents_; }
  /// Nothing in a recording that was cut off.
  const std::optional<RunEnd>& end() const { return end_; }
  const std::optional<mcap::Tear>& tear() const { return last_file().reader_.tear(); }
  /// How many files it is in.
  std::size_t pieces() const { return 1 + later_.size(); }
  /// The file in which it should go on, and that is not there; empty if nothing says so.
  const std::string& missing_piece() const { return missing_piece_; }
  /// The first of its files behind the missing one: it is not read. Empty: there is none.
  std::string unread_piece() const;
  /// Whether its recorder finished it, and all of it is there.
  bool complete() const { return end_.has_value() && !tear(); }
  /// Why it need not hold its run to the end, nor all topics up to the same tick: `was cut off`, or
  /// `is of a run that was aborted (...)`. Empty if there is no reason.
  std::string cut_off() const;

  /// Samples of types that were others then are given in today's: see OlderType. So all who read
  /// samples read those of older versions, too.
  SampleStream samples(const SampleFilter& filter = {}) const { return stream(filter, older_); }
  /// Samples with the bytes that the file has.
  SampleStream raw_samples(const SampleFilter& filter = {}) const {
    return stream(filter, nullptr);
  }
  /// The description with the schemas of what samples() gives.
  RunDescription description_of_samples() const;
  /// Whether the recording's own type of the topic has the field: `motion.kind`.
  bool has_field(domain::Topic topic, std::string_view path) const;

  /// Reads all samples. Refused: a changed byte, and samples that are not in canonical order.
  core::Result<RunSurvey> survey_samples() const;
  /// The same, and refused is a hash other than the one that the recorder wrote.
  core::Result<RunSurvey> survey() const;

 private:
  RunRecording(std::string path, mcap::McapReader reader);
  core::Result<void> open_later_files();
  core::Result<void> check_follows(const RunRecording& before) const;
  const RunRecording& last_file() const { return later_.empty() ? *this : later_.back(); }
  /// The messages of this file; the filter's channels follow from `wanted`, empty: all.
  SampleStream::Part part(const std::set<domain::Topic>& wanted, mcap::MessageFilter filter) const;
  core::Result<void> read_description();
  core::Result<void> read_attachments();
  core::Result<void> read_topics();
  SampleStream stream(const SampleFilter& filter, std::shared_ptr<const OlderTypes> older) const;
  core::Result<void> read_side_channels();
  /// The entries of a side channel: `from_json(tick, json)` gives one, or none.
  template <typename Entry, typename FromJson>
  core::Result<void> read_entries(std::string_view topic, const char* noun,
                                  const FromJson& from_json, std::vector<Entry>& entries) const;
  /// The messages of channels of this topic.
  mcap::MessageFilter only(std::string_view topic) const;
  core::Error error(const std::string& message) const { return {message, path_, 0, 0}; }

  std::string path_;
  mcap::McapReader reader_;
  RunDescription description_;
  std::optional<RunEnd> end_;
  std::vector<domain::Intervention> interventions_;
  std::vector<domain::Incident> incidents_;
  std::map<std::string, std::string> intervention_files_;  ///< by tick, a slash and the name
  std::map<std::uint16_t, domain::Topic> topics_;          ///< by channel
  std::shared_ptr<const OlderTypes> older_;
  std::string missing_piece_;
  std::vector<RunRecording> later_;  ///< the other files of one that is split
};

}  // namespace clew::bridge
