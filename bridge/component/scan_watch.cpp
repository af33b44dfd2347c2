// SPDX-License-Identifier: Apache-2.0
#include "component/scan_watch.hpp"

#include <algorithm>
#include <string_view>
#include <variant>

namespace clew::bridge {
namespace {

constexpr double kMoved_m = 0.05;
constexpr double kFrozenAfter_s = 0.2;
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

std::optional<std::string> ScanWatch::see(std::uint64_t tick, const runtime::TopicSet& present,
                                          const domain::Messages& messages) {
  if (!readings_vary_) return std::nullopt;
  if (!present[index_of(domain::Topic::kScan)]) return std::nullopt;
  if (!present[index_of(domain::Topic::kOdometry)]) return std::nullopt;
  if (!repeats(tick, std::get<domain::Scan>(messages), std::get<domain::Odometry>(messages))) {
    return std::nullopt;
  }
  return "the sensor is frozen: its readings are those of tick " + std::to_string(since_) +
         ", to the bit, though the robot has moved by more than 5 cm";
}

bool ScanWatch::repeats(std::uint64_t tick, const domain::Scan& scan,
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
    return false;
  }
  const double age_s = static_cast<double>(tick - since_) * tick_s_ + kSameTime_s;
  const bool moved = odometry.travel_m - travel_m_ > kMoved_m;
  if (!returned_ || !moved || age_s < std::max(kFrozenAfter_s, tick_s_)) return false;
  travel_m_ = odometry.travel_m;
  return true;
}

std::optional<std::string> ScanWatch::arrive(std::uint64_t stamp_tick, Time now) {
  if (!stamp_tick_ || stamp_tick > *stamp_tick_) {
    stamp_tick_ = stamp_tick;
    stamped_at_ = now;
    stamp_told_ = false;
    return std::nullopt;
  }
  const double age_s = std::chrono::duration<double>(now - stamped_at_).count();
  if (stamp_told_ || age_s < std::max(kFrozenAfter_s, tick_s_)) return std::nullopt;
  stamp_told_ = true;
  return "the sensor is frozen: it writes its scan of tick " + std::to_string(stamp_tick) +
         " again";
}

}  // namespace clew::bridge
