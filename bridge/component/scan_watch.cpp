// SPDX-License-Identifier: Apache-2.0
#include "component/scan_watch.hpp"

#include <algorithm>
#include <string_view>
#include <variant>

#include "run/limits.hpp"

namespace clew::bridge {
namespace {

constexpr double kMoved_m = 0.05;
constexpr double kStaleAfter_s = 0.2;
constexpr double kNoneAfter_s = 0.3;
/// Times are products of ticks: so much is no difference.
constexpr double kSameTime_s = 1e-9;
/// Noise below this may be lost in the last digits of a reading.
constexpr double kLeastNoise_m = 1e-6;

double number_of(const runtime::PartChoice& choice, const std::string& parameter) {
  const auto found = choice.parameters.find(parameter);
  const double* number =
      found == choice.parameters.end() ? nullptr : std::get_if<double>(&found->second);
  return number == nullptr ? 0.0 : *number;
}

/// Whether two readings of a return are never the same.
bool readings_vary(const runtime::Graph& graph) {
  const runtime::GraphStage* sensor = graph.writer_of(domain::Topic::kScan);
  if (sensor == nullptr) return false;
  const auto& parts = sensor->config.parts;
  return std::any_of(parts.begin(), parts.end(), [](const auto& part) {
    return std::any_of(part.second.begin(), part.second.end(), [](const auto& choice) {
      return number_of(choice, "noise_stddev_m") > kLeastNoise_m &&
             number_of(choice, "resolution_m") == 0.0;
    });
  });
}

std::string_view bytes_of(const domain::Scan& scan) {
  return {reinterpret_cast<const char*>(scan.ranges_m.data()),
          scan.ranges_m.size() * sizeof(double)};
}

}  // namespace

ScanWatch::ScanWatch(const runtime::RunPlan& plan)
    : ScanWatch(plan.graph.tick_s, readings_vary(plan.graph)) {}

std::optional<ScanWatch::News> ScanWatch::see(std::uint64_t tick, const runtime::TopicSet& present,
                                              const domain::Messages& messages) {
  if (!readings_vary_) return std::nullopt;
  if (!present[index_of(domain::Topic::kScan)]) return std::nullopt;
  if (!present[index_of(domain::Topic::kOdometry)]) return std::nullopt;
  return see_readings(tick, std::get<domain::Scan>(messages), std::get<domain::Odometry>(messages));
}

std::optional<ScanWatch::News> ScanWatch::see_readings(std::uint64_t tick, const domain::Scan& scan,
                                                       const domain::Odometry& odometry) {
  const core::Hash128 readings = core::hash128(bytes_of(scan));
  if (!known_ || readings != readings_) {
    known_ = true;
    readings_ = readings;
    returned_ = std::any_of(scan.ranges_m.begin(), scan.ranges_m.end(), [&](double range_m) {
      return scan.range_min_m < range_m && range_m < scan.range_max_m;
    });
    since_ = tick;
    travel_m_ = odometry.travel_m;
    return trust_again(in_readings_);
  }
  const bool moved = odometry.travel_m - travel_m_ > kMoved_m;
  // What was told stays so while the readings do.
  if (!returned_ || (!moved && in_readings_ != Trust::kStale)) return std::nullopt;
  const Trust trust = trust_after(static_cast<double>(tick - since_) * tick_s_ + kSameTime_s);
  if (trust == Trust::kFull || (trust == Trust::kStale && in_readings_ != Trust::kFull)) {
    return std::nullopt;
  }
  in_readings_ = trust;
  travel_m_ = odometry.travel_m;
  const std::string why = "its readings are those of tick " + std::to_string(since_) +
                          ", to the bit, though the robot has moved by more than 5 cm";
  if (trust == Trust::kStale) return News{kStale, "the sensor is stale: " + why};
  return News{kFrozen, "the sensor is frozen: " + why};
}

std::optional<ScanWatch::News> ScanWatch::trust_again(Trust& trust) {
  if (trust == Trust::kFull) return std::nullopt;
  trust = Trust::kFull;
  if (in_readings_ != Trust::kFull || in_stamps_ != Trust::kFull) return std::nullopt;
  // With the tick: a thing that is told once more in the same words is passed over.
  const std::uint64_t tick = std::max(since_, stamp_tick_.value_or(0));
  return News{kFresh, "the sensor is fresh again, since its scan of tick " + std::to_string(tick)};
}

ScanWatch::Trust ScanWatch::trust_after(double age_s) const {
  if (age_s >= std::max(kNoneAfter_s, 2.0 * tick_s_)) return Trust::kNone;
  return age_s >= std::max(kStaleAfter_s, tick_s_) ? Trust::kStale : Trust::kFull;
}

std::optional<ScanWatch::News> ScanWatch::scan_arrives(std::uint64_t stamp_tick, Time now) {
  if (stamp_tick_ && stamp_tick <= *stamp_tick_) {
    repeated_ = repeated_ || stamp_tick == *stamp_tick_;
    return look(now);
  }
  stamp_tick_ = stamp_tick;
  repeated_ = false;
  waits_since_.reset();
  return trust_again(in_stamps_);
}

// A sensor writes when drive has begun a tick: until then nothing is due.
void ScanWatch::odometry_arrives(std::uint64_t stamp_tick, Time now) {
  if (stamp_tick_ && stamp_tick > *stamp_tick_ && !waits_since_) waits_since_ = now;
}

std::optional<ScanWatch::News> ScanWatch::look(Time now) {
  forgive_sleep(now);
  if (!waits_since_) return std::nullopt;
  const double age_s = std::chrono::duration<double>(now - *waits_since_).count();
  const Trust trust = trust_after(age_s);
  if (trust <= in_stamps_) return std::nullopt;
  in_stamps_ = trust;
  const std::string tick = std::to_string(*stamp_tick_);
  const std::string why = repeated_ ? "it writes its scan of tick " + tick + " again"
                                    : "it has written nothing since its scan of tick " + tick;
  if (trust == Trust::kStale) return News{kStale, "the sensor is stale: " + why};
  if (repeated_) return News{kFrozen, "the sensor is frozen: " + why};
  return News{kGone, "the sensor is gone: " + why};
}

// Who was asleep cannot say that nothing came.
void ScanWatch::forgive_sleep(Time now) {
  if (waits_since_ && now - std::max(looked_at_, *waits_since_) > kScanWatchAwake) {
    *waits_since_ = std::min(now, *waits_since_ + (now - std::max(looked_at_, *waits_since_)));
  }
  looked_at_ = now;
}

}  // namespace clew::bridge
