// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "line/acceptor.hpp"
#include "line/domain_lock.hpp"
#include "replay/audience.hpp"
#include "replay/fed_component.hpp"
#include "replay/live_replay.hpp"
#include "replay/playback.hpp"
#include "replay/tick_reader.hpp"
#include "replay/topic_publisher.hpp"
#include "run/end_signals.hpp"

namespace clew::bridge {

/// A replay on the wire while it goes on: see replay_live. All arguments must outlive it.
class LiveReplay {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Now = std::function<Time()>;

  LiveReplay(const RunRecording& recording, const runtime::RunPlan& recorded,
             const runtime::RunPlan& plan, const LiveReplayOptions& options,
             PlaybackConsole& console, DomainLock hold, Now now = std::chrono::steady_clock::now);

  /// Creates what is published and compared, and starts what is to be started.
  core::Result<void> open();

  /// Goes on until all is published and compared, or something stops it.
  LiveReplayReport run();

 private:
  enum class Phase : std::uint8_t { kWaiting, kFeeding, kDraining, kOver };

  void stop(const std::string& why);
  core::Result<void> adopt(const runtime::GraphStage& stage);
  void welcome(std::unique_ptr<Link> link, const Hello& hello);
  void look_after_others();
  void wait_for_something();
  /// Until something may be due that no descriptor tells of.
  Time::duration patience() const;
  void take_signals();
  void take_requests();
  void take_seek(const PlaybackRequest& request);
  std::uint64_t skip_ticks() const;
  void seek(std::uint64_t tick);
  void advance();
  double wait_s() const;
  bool everybody_ready() const;
  std::string missing_text() const;
  void begin();
  bool too_far_ahead() const;
  bool publish_next();
  bool begin_next();
  bool write_next();
  bool take_next();
  std::string published() const;
  void notice_hold_up();
  void drain();
  void try_to_finish();
  void end();
  std::uint64_t next_tick() const;
  bool halted() const;
  void show(bool at_once);

  const RunRecording& recording_;
  const runtime::RunPlan& recorded_;
  const runtime::RunPlan& plan_;
  const LiveReplayOptions& options_;
  PlaybackConsole& console_;
  const Now now_;
  DomainLock domain_lock_;
  Acceptor acceptor_;
  EndSignals signals_;  // before any thread of a vendor's
  const WireSettings settings_;
  Audience audience_;
  std::unique_ptr<Participant> participant_;
  std::optional<TopicPublisher> publisher_;
  std::unique_ptr<FedComponent> component_;
  std::optional<TickReader> reader_;
  Playback playback_;
  LiveReplayReport report_;
  Phase phase_ = Phase::kWaiting;
  const RecordedTick* next_ = nullptr;  // the tick that is being published, or is next
  bool begun_ = false;
  bool held_up_ = false;
  std::optional<std::uint64_t> last_tick_;
  Time asked_at_{};
  Time began_at_{};
  std::optional<Time> done_at_;
  Time moved_at_{};
  Time shown_at_{};
};

}  // namespace clew::bridge
