// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "replay/component_replay.hpp"
#include "replay/playback.hpp"
#include "replay/topic_publisher.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// How a recording is put on the wire.
struct LiveReplayOptions {
  /// Topics to publish; the inputs of `component` are in any case.
  runtime::TopicSet topics;
  /// The stage that is fed and compared; empty: that of the first `clew component` that comes.
  std::string component;
  /// Of the component's prefix: `gdb --args`.
  std::string prefix;
  bool starts_component = false;     ///< else somebody else starts it
  std::vector<std::string> readers;  ///< programs to start beside, command lines of a shell
  ReplayRange range;                 ///< a component is fed from tick 0 in any case, at once
  bool paused = false;               ///< before the first tick of the range
  bool loops = false;                ///< from the end of the range back to its beginning
  TopicNames names;                  ///< under which topics are published, other than their own
  std::optional<double> wait_s;      ///< for readers; none: as long as the graph waits for a start
  std::string program;               ///< the clew command
  std::string middleware = "cyclonedds";
  std::optional<int> domain;  ///< none: the first free one
};

/// What a replay on the wire is at.
struct LiveReplayStatus {
  std::uint64_t next_tick = 0;  ///< to be published
  double tick_s = 0.0;
  bool waiting = true;  ///< for readers
  bool paused = false;
  bool halted = false;  ///< paused, and every tick asked for is published and compared
  double rate = 0.0;
  const ReplayReport* component = nullptr;  ///< null: none is compared
};

/// Who steers a replay while it goes on, and sees how it does.
class PlaybackConsole {
 public:
  virtual ~PlaybackConsole() = default;
  /// To be polled for input; -1: none.
  virtual int descriptor() const = 0;
  /// What was asked for since the last call.
  virtual std::vector<PlaybackRequest> take() = 0;
  /// Called ten times a second, and after each request.
  virtual void show(const LiveReplayStatus& status) = 0;
  /// A line for people.
  virtual void log(const std::string& line) = 0;
};

struct LiveReplayReport {
  int domain = 0;
  std::uint64_t ticks = 0;  ///< published
  std::map<domain::Topic, std::uint64_t> samples;
  std::optional<ReplayReport> component;
  double ticks_per_s = 0.0;
  std::string stopped;     ///< why it did not come to its end; empty: it did, or was told to stop
  int interrupted_by = 0;  ///< the signal
};

/// Publishes recorded topics over DDS, as the recorded writers would have, once everybody is there
/// who is to read them: at least one reader of each topic, and every endpoint of the component.
/// Ends when every live reader has acknowledged everything and every output is compared. `recorded`
/// is the recording's own plan, `plan` what a component is given.
///
/// Refused: to loop, or to rename an input, beside a component, which is in step with the run;
/// a topic that is not recorded, that the component writes itself or that nobody reads in it, a
/// stage that is not in the graph, nothing to publish, a domain that is taken; a recording that
/// lacks a sample of the component's, and as drive's, one with late commands or that branched off
/// another.
core::Result<LiveReplayReport> replay_live(const RunRecording& recording,
                                           const runtime::RunPlan& recorded,
                                           const runtime::RunPlan& plan,
                                           const LiveReplayOptions& options,
                                           PlaybackConsole& console);

}  // namespace clew::bridge
