// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/hash128.hpp"
#include "core/result.hpp"
#include "domain/incident.hpp"
#include "domain/topics.hpp"
#include "recording/mcap_writer.hpp"
#include "recording/recorded_incident.hpp"
#include "recording/recorded_intervention.hpp"
#include "recording/run_description.hpp"
#include "recording/sample_losses.hpp"
#include "recording/sample_queue.hpp"
#include "recording/side_channel.hpp"

namespace clew::bridge {

/// Writes the recording of a run: an MCAP file with the run's description in front, then its
/// samples in canonical order (tick, topic, sequence), whatever the order in which the topics
/// deliver them. A chunk holds one second of simulated time. The same run gives the same bytes.
///
/// A recording that is split (RunDescription::split) goes on in further files, between two ticks.
/// The first file keeps its temporary name until all is there; each of the others gets its name
/// when it is full.
class RunRecorder {
 public:
  /// Errors are those of the file: see mcap::OutputFile. `overwrite` is meant for every file of a
  /// recording that is split.
  static core::Result<RunRecorder> create(const std::string& path,
                                          const RunDescription& description, bool overwrite);

  /// Writes what a recording begins with into the file that is reserved for `path`: from here on
  /// the run can be gone on with, whatever dies.
  static core::Result<void> describe(const std::string& path, const RunDescription& description);

  /// Goes on with the file that stands under the temporary name of `path`, reserved only or left by
  /// a recorder of the same run that was cut off: keeps its whole chunks and replaces what follows.
  /// Refused: a file whose whole chunks hold fewer than `least_ticks` ticks, and one that is not of
  /// this description; it is then left as it is. Further files of a recording that is split replace
  /// others of their names if `overwrite`.
  static core::Result<RunRecorder> go_on(const std::string& path, const RunDescription& description,
                                         std::uint64_t least_ticks = 0, bool overwrite = false);

  /// Whether a file, by itself, holds at least one sample of a run that a recorder can go on with.
  /// One whose recorder died before it was a recording holds none. Any other that cannot be read
  /// is an error.
  static core::Result<bool> holds_samples(const std::string& file);

  /// Takes a sample and writes what has become complete. A sample of a tick that its topic has
  /// already is passed over: a writer that was restarted writes it again. Ticks that the topic
  /// skips, or has not delivered when another is kMaxWaitingTicks ahead, are lost(). Refused: a
  /// topic that the description does not have, and what the file refuses.
  core::Result<void> add(domain::Topic topic, std::uint64_t tick, std::uint64_t sequence,
                         std::string_view cdr);

  /// Takes what somebody changed in the run; it is written before the samples of its tick. One that
  /// it has already is passed over.
  void add_intervention(const domain::Intervention& intervention);
  /// Takes what befell the run; it is written before the next tick that is, if its own is written
  /// already. The same told again is passed over.
  void add_incident(domain::Incident incident);

  /// Ticks below this one have a sample of every topic, but for those that are lost.
  std::uint64_t complete_ticks() const { return complete_ticks_; }
  /// Ticks below this one are in closed chunks: they outlive this process.
  std::uint64_t durable_ticks() const { return durable_ticks_; }
  /// What the recording lacks so far.
  const SampleLosses& losses() const { return losses_; }

  /// Leaves what is in the open chunk in the file too, until the chunk is closed.
  core::Result<void> write_ahead() { return writer_.write_ahead(); }

  /// Writes what is still waiting (of a run that was cut off), the run's end and the index, and
  /// closes the file, which keeps its temporary name. Nothing may follow. `aborted` says why the
  /// run has no outcome: its topics end where their writers were, and what others have beyond that
  /// is not lost. `run_hash` is written where the recording lacks topics of the run.
  core::Result<void> seal(const std::string& aborted = {},
                          const std::optional<core::Hash128>& run_hash = {});
  /// The same, and gives the file its name.
  core::Result<void> finish(const std::string& aborted = {},
                            const std::optional<core::Hash128>& run_hash = {});

  /// By topic, of what was written so far; topics without a sample are left out.
  std::map<std::string, core::Hash128> chains() const;

  static constexpr std::size_t kMaxWaitingTicks = 1024;

 private:
  struct RecordedTopic {
    domain::Topic topic = domain::Topic::kCommand;
    std::uint16_t channel_id = 0;
    SampleQueue waiting;
    std::uint64_t next_tick = 0;  ///< after the last one that was added
    std::optional<std::uint64_t> next_sequence;
    bool written = false;
    core::HashChain chain;
  };

  RunRecorder(mcap::McapWriter writer, std::string path, const RunDescription& description);
  static core::Result<mcap::McapWriter> begin_file(mcap::OutputFile file,
                                                   const RunDescription& description);
  static core::Result<RunRecorder> start(mcap::OutputFile file, const RunDescription& description);
  core::Result<void> keep(const std::string& file);
  void declare_topics();
  bool piece_is_full(std::uint64_t next_tick) const;
  core::Result<void> close_piece();
  core::Result<void> open_next_piece(std::uint64_t first_tick);
  void note_sequence(RecordedTopic& recorded, std::uint64_t tick, std::uint64_t sequence);
  bool every_topic_waits() const;
  bool any_topic_waits() const;
  core::Result<void> write_tick(bool topics_may_end = false);
  core::Result<void> write_front(RecordedTopic& topic);
  core::Result<void> write_side_channels(std::uint64_t tick);
  core::Result<void> write_ending(const std::string& aborted,
                                  const std::optional<core::Hash128>& run_hash);

  mcap::McapWriter writer_;
  std::string path_;  ///< of the first file
  RunDescription description_;
  double tick_s_;
  std::optional<std::uint64_t> piece_tick_;        ///< the first one of this file
  std::uint64_t beginning_bytes_ = 0;              ///< of this file: what every file repeats
  bool keeps_ = false;                             ///< what it writes stands there already
  bool overwrite_ = false;                         ///< files behind the first one
  bool went_on_ = false;                           ///< growing files of their names are its own
  mcap::FileLock first_file_;                      ///< once it is sealed, until all is there
  std::vector<RecordedTopic> topics_;              ///< in the order of their names
  std::array<int, domain::kTopicCount> places_{};  ///< in topics_, by domain::Topic; < 0: none
  std::optional<std::uint64_t> next_tick_;         ///< to be written; none: the first that comes
  std::uint64_t complete_ticks_ = 0;
  std::uint64_t durable_ticks_ = 0;
  SampleLosses losses_;
  SideChannel<domain::Intervention> interventions_{kInterventionChannel};
  SideChannel<domain::Incident> incidents_{kIncidentChannel};
};

}  // namespace clew::bridge
