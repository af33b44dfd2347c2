// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/hash128.hpp"
#include "core/result.hpp"
#include "domain/intervention.hpp"
#include "domain/topics.hpp"
#include "recording/compression.hpp"
#include "recording/mcap_records.hpp"

namespace clew::bridge {

/// Where a recording begins that lacks the first ticks of its run, and with what.
struct BlackBoxStart {
  /// The first tick that can be repeated. The samples of the one before are there for inputs that
  /// are taken a tick later.
  std::uint64_t tick = 0;
  std::string why;                            ///< what made the box write
  std::map<std::string, std::string> states;  ///< by stage, before it steps `tick`; none at tick 0
};

template <typename V>
void visit_fields(V& v, BlackBoxStart& s) {
  v(s.tick, s.why, s.states);
}

/// When a recording goes on in another file. Zero: never for this reason.
struct RecordingSplit {
  std::uint64_t bytes = 0;  ///< a file that is so large takes no further tick
  double seconds = 0.0;     ///< of simulated time: a file holds the ticks of one such interval

  bool any() const { return bytes > 0 || seconds > 0.0; }
};

template <typename V>
void visit_fields(V& v, RecordingSplit& s) {
  v(s.bytes, s.seconds);
}

/// What a run is a function of, and nothing else: no wall clock, host, process, layout or
/// middleware. The same run has the same description wherever it goes.
struct RunDescription {
  double tick_s = 0.0;  ///< simulated time of a tick, 1e-6..1e6
  std::uint64_t seed = 0;
  std::map<std::string, std::string> versions;  ///< by program or library: `clew` to `0.1.0`
  std::string idl_fingerprint;
  /// The texts that the run was made of, by name: `graph.yaml`, `world.yaml`, `robot.yaml`, ...
  std::map<std::string, std::string> bundle;
  /// IDL text by topic: every topic of the run that is recorded.
  std::map<domain::Topic, std::string> schemas;
  /// Of the file and not of the run, as what follows: how its chunks are packed.
  mcap::Compression compression = mcap::Compression::kNone;
  /// Topics of the run that the user left out of its recording.
  std::set<domain::Topic> left_out;
  RecordingSplit split;
  std::uint64_t piece = 0;    ///< which file of a recording that is split, from 0
  core::Hash128 hash_before;  ///< of the samples in the files before it
  /// Only of what a black box wrote.
  std::optional<BlackBoxStart> black_box;
  /// What was to be changed at set ticks, whether the run got there or not; with files that are in
  /// the bundle.
  std::vector<domain::Intervention> planned;
};

template <typename V>
void visit_fields(V& v, RunDescription& d) {
  v(d.tick_s, d.seed, d.versions, d.idl_fingerprint, d.bundle, d.schemas, d.compression, d.left_out,
    d.split, d.piece, d.hash_before, d.black_box, d.planned);
}

/// How a recording ended: written by its recorder after the last sample.
struct RunEnd {
  std::uint64_t ticks = 0;         ///< for which every topic has a sample
  core::Hash128 hash;              ///< run_hash of all topics that are recorded
  std::uint64_t lost_samples = 0;  ///< that writers should have written and the recording lacks
  /// Why the run has no outcome; empty if it has one. Topics of a run that was aborted may have
  /// samples of later ticks than `ticks`, each up to another one.
  std::string aborted;
  /// Of the whole run, where the recording lacks topics and the run was hashed.
  std::optional<core::Hash128> run_hash = {};
  bool continues = false;  ///< in a next file: the counts and the hash are those up to there
};

/// The metadata records that carry them (bundle and schemas have records of their own). Metadata
/// have no CRC in MCAP, so each carries a hash of its entries.
mcap::Metadata to_metadata(const RunDescription& description);
mcap::Metadata to_metadata(const RunEnd& end);

/// Attachments of a black box: a stage's state, under this and the stage's name.
inline constexpr const char* kStatePrefix = "state/";

/// Names of those records.
inline constexpr const char* kDescriptionName = "clew";
inline constexpr const char* kEndName = "clew_end";

/// Refused: entries that were changed or are missing, numbers that are none, and recordings of
/// another format.
core::Result<RunDescription> description_from_metadata(const mcap::Metadata& metadata);
core::Result<RunEnd> end_from_metadata(const mcap::Metadata& metadata);

/// Simulated time at the start of a tick: llround(tick * tick_s * 1e9); a recording's log time.
std::uint64_t tick_to_ns(std::uint64_t tick, double tick_s);
/// The tick that a recording's log time belongs to.
std::uint64_t ns_to_tick(std::uint64_t time_ns, double tick_s);

}  // namespace clew::bridge
