// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/no_safe_region.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "scan/scan_needs.hpp"

namespace clew::recover {
namespace {

std::string in_degrees(double angle_rad) {
  return std::to_string(std::lround(core::degrees(angle_rad))) + " deg";
}

}  // namespace

core::Result<std::unique_ptr<NoSafeRegion>> NoSafeRegion::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  scan::ScanNeeds needs;
  needs.most_unseen_rad = core::radians(15.0);
  needs.least_field_rad = 2.0 * parameters.sector_rad * parameters.seen_ratio;
  needs.field_reason = "seen_ratio of twice sector_deg";
  CLEW_RETURN_IF_ERROR(scan::check_needs(needs, setup.scan, "no_safe_region"));
  return std::make_unique<NoSafeRegion>(parameters, setup.robot.radius_m);
}

std::optional<TrapEvidence> NoSafeRegion::observe(const Situation& situation) {
  state_.in_a_row = surrounded(situation) ? state_.in_a_row + 1 : 0;
  if (state_.in_a_row == 0) state_.told = false;
  if (state_.told || state_.in_a_row < parameters_.ticks) return std::nullopt;
  state_.told = true;
  return TrapEvidence{std::nullopt,
                      "no gap within " + in_degrees(parameters_.sector_rad) + " of the target"};
}

/// Whether nothing in view leads to the active target, and enough is in view.
bool NoSafeRegion::surrounded(const Situation& situation) {
  regions_.update(situation.scan);
  const double target_rad = core::bearing_rad(situation.pose(), situation.pursued_odom);
  const double depth_m = std::min(parameters_.depth_ratio * situation.scan.range_max_m,
                                  core::distance_m(situation.pose(), situation.pursued_odom));
  const auto leads_to_target = [&](std::size_t i) {
    const double off_rad = core::wrap_angle_rad(regions_.bearing_rad(i) - target_rad);
    return std::fabs(off_rad) <= parameters_.sector_rad;
  };
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    if (regions_.free_m(i) >= depth_m && leads_to_target(i)) return false;
  }
  const double step_rad = std::fabs(situation.scan.bearing_step_rad);
  const double needed_rad = 2.0 * parameters_.sector_rad * parameters_.seen_ratio;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    if (leads_to_target(i) && static_cast<double>(++seen) * step_rad >= needed_rad) return true;
  }
  return false;
}

void NoSafeRegion::save(core::StateWriter& writer) const { writer(state_); }

void NoSafeRegion::load(core::StateReader& reader) {
  reader(state_);
  // More ticks than any run has are a stranger's.
  constexpr std::int64_t kMostTicks = 1'000'000'000'000'000;
  const bool counts = state_.in_a_row >= 0 && state_.in_a_row < kMostTicks;
  if (!reader.check(counts, "a number of ticks is none")) state_ = {};
}

}  // namespace clew::recover
