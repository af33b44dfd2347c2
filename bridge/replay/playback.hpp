// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace clew::bridge {

/// What a person or a script asks of a replay on the wire.
struct PlaybackRequest {
  enum class Kind : std::uint8_t {
    kPause,
    kResume,
    kToggle,
    kStep,
    kRate,
    kFaster,
    kSlower,
    kSeek,
    kSkipBack,
    kSkipOn,
    kEnd
  };
  Kind kind = Kind::kToggle;
  std::uint64_t ticks = 1;  ///< with kStep; with kSeek the next one
  double rate = 0.0;        ///< with kRate, as Playback::rate()
};

/// When the next recorded tick may be published: never while paused but for single ticks, at a
/// multiple of simulated time, or at once.
class Playback {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Rates that can be asked for.
  static constexpr double kLowestRate = 0.001;
  static constexpr double kHighestRate = 1000.0;

  Playback(double tick_s, double rate, bool paused);

  bool paused() const { return paused_; }
  /// Paused, and every single tick that was asked for has begun.
  bool halted() const { return paused_ && steps_ == 0; }
  /// Simulated over wall-clock time; 0: as fast as the ticks are taken.
  double rate() const { return rate_; }

  /// The first tick is due now.
  void start(Time now) { due_ = now; }
  /// Everything but where to go on and kEnd, which are the caller's. A step pauses; ticks not yet
  /// begun add up.
  void apply(const PlaybackRequest& request, Time now);

  /// Whether a tick may begin.
  bool may_begin(Time now) const;
  /// When to ask again; none: after the next request.
  std::optional<Time> due() const;
  /// A tick begins. Ticks that were held up by their readers are not made up for.
  void begin(Time now);

 private:
  void set_rate(double rate, Time now);

  double tick_s_;
  double rate_;
  bool paused_;
  std::uint64_t steps_ = 0;
  Time due_{};
};

}  // namespace clew::bridge
