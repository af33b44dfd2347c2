// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "core/hash128.hpp"
#include "domain/messages.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// Notices a range sensor whose scans are of the past: one that writes the same readings again and
/// again with new stamps, one that writes the same stamp, and one that writes nothing.
///
/// The readings of a noisy sensor never repeat to the bit where something returned. If they do, and
/// the robot has moved by more than 5 cm by its odometry meanwhile, then the sensor is frozen.
/// Where nothing returned there is nothing to repeat, and of a sensor without noise, or one whose
/// readings are rounded, nothing can be said. Of a sensor that writes no new stamp only the time
/// counts in which drive has gone on and the watch itself was awake.
///
/// After the larger of 0.2 s and a tick the sensor is stale, and the robot should go slowly; after
/// the larger of 0.3 s and two ticks it is frozen or gone, and the robot should rest.
class ScanWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // The kinds of domain::Incident that it tells.
  static constexpr const char* kStale = "stale_sensor";
  static constexpr const char* kFrozen = "frozen_sensor";  ///< the same readings or stamp again
  static constexpr const char* kGone = "gone_sensor";
  static constexpr const char* kFresh = "fresh_sensor";  ///< it was stale, and is as it should be

  struct News {
    const char* kind = nullptr;
    std::string text;
  };

  /// Of the plan it needs the duration of a tick and what the graph says of the sensor's noise.
  explicit ScanWatch(const runtime::RunPlan& plan);
  ScanWatch(double tick_s, bool readings_vary) : tick_s_(tick_s), readings_vary_(readings_vary) {}

  /// Whether anything can be said of equal readings.
  bool watches_readings() const { return readings_vary_; }
  /// Takes the inputs of a tick, one tick after the other. That the sensor is frozen it says again
  /// each time that the robot has gone 5 cm on.
  std::optional<News> see(std::uint64_t tick, const runtime::TopicSet& present,
                          const domain::Messages& messages);

  // In real time only, where no writer has a reason to write twice, nor to be late.

  /// Takes the stamp of a scan that arrives, known already or not.
  std::optional<News> scan_arrives(std::uint64_t stamp_tick, Time now);
  /// Takes the stamp of an odometry: drive is so far.
  void odometry_arrives(std::uint64_t stamp_tick, Time now);
  /// Looks at the clock. Who does not look for longer than kScanWatchAwake was asleep himself.
  std::optional<News> look(Time now);

 private:
  enum class Trust { kFull, kStale, kNone };

  std::optional<News> see_readings(std::uint64_t tick, const domain::Scan& scan,
                                   const domain::Odometry& odometry);
  std::optional<News> trust_again(Trust& trust);
  void forgive_sleep(Time now);
  /// What trust remains in a sensor that is so old.
  Trust trust_after(double age_s) const;

  const double tick_s_;
  const bool readings_vary_;
  core::Hash128 readings_;   // of the last scan
  bool known_ = false;       // there was one
  bool returned_ = false;    // something, in it
  std::uint64_t since_ = 0;  // the tick of the first scan with these readings
  double travel_m_ = 0.0;    // what the robot had gone then, or when it was told last
  Trust in_readings_ = Trust::kFull;
  std::optional<std::uint64_t> stamp_tick_;  // the newest that has arrived
  bool repeated_ = false;                    // it has arrived again
  std::optional<Time> waits_since_;          // that a newer one has been due
  Trust in_stamps_ = Trust::kFull;
  Time looked_at_{};
};

}  // namespace clew::bridge
