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

/// Notices a range sensor that is frozen: one that writes the same readings again and again with
/// new stamps, or the same stamp.
///
/// The readings of a noisy sensor never repeat to the bit where something returned. If they do for
/// the larger of 0.2 s and a tick, and the robot has moved by more than 5 cm by its odometry
/// meanwhile, then what the scans show is of the past. Where nothing returned there is nothing to
/// repeat, and of a sensor without noise, or one whose readings are rounded, nothing can be said.
class ScanWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// The kind of domain::Incident that it is.
  static constexpr const char* kIncident = "frozen_sensor";

  /// Of the plan it needs the duration of a tick and what the graph says of the sensor's noise.
  explicit ScanWatch(const runtime::RunPlan& plan);
  ScanWatch(double tick_s, bool readings_vary) : tick_s_(tick_s), readings_vary_(readings_vary) {}

  /// Whether anything can be said of equal readings.
  bool watches_readings() const { return readings_vary_; }
  /// Takes the inputs of a tick, one tick after the other; why the sensor is frozen, if it is. It
  /// says so again each time that the robot has gone 5 cm on.
  std::optional<std::string> see(std::uint64_t tick, const runtime::TopicSet& present,
                                 const domain::Messages& messages);
  /// Takes the stamp of a scan that arrives, known already or not; in real time only, where no
  /// writer has a reason to write twice. Why the sensor is frozen, once for a stamp.
  std::optional<std::string> arrive(std::uint64_t stamp_tick, Time now);

 private:
  bool repeats(std::uint64_t tick, const domain::Scan& scan, const domain::Odometry& odometry);

  const double tick_s_;
  const bool readings_vary_;
  core::Hash128 readings_;   // of the last scan
  bool known_ = false;       // there was one
  bool returned_ = false;    // something, in it
  std::uint64_t since_ = 0;  // the tick of the first scan with these readings
  double travel_m_ = 0.0;    // what the robot had gone then, or when it was told last
  std::optional<std::uint64_t> stamp_tick_;  // the newest that has arrived
  Time stamped_at_{};
  bool stamp_told_ = false;
};

}  // namespace clew::bridge
