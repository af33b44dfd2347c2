// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "control/gaps/nearest_virtual_target.hpp"
#include "domain/words.hpp"
#include "scan/nearest_return.hpp"

namespace clew::control {
namespace {

// Values along each axis of the control surface, which ends at these two.
constexpr std::size_t kOutputs = 19;
constexpr double kMostDistance_m = 2.0;

}  // namespace

void NearestVirtualTarget::tell(const domain::Odometry& odometry, const domain::Scan& scan,
                                const core::Vec2& target_odom, domain::Inside& inside) const {
  const core::Pose2& pose = odometry.pose_odom_robot;
  tell_gaps(pose, target_odom, inside);
  const core::Vec2 goal = state_.has_gap ? state_.virtual_target_odom : target_odom;
  const double bearing_rad = core::bearing_rad(pose, goal);
  const scan::Return nearest = scan::nearest_return(scan);
  const double position_rad =
      nearest.range_m < scan.range_max_m
          ? std::fabs(core::wrap_angle_rad(nearest.bearing_rad - bearing_rad))
          : core::kPi;
  tell_rules(position_rad, nearest.range_m, inside);
}

/// The safe regions at the depth that was taken, each with its virtual target.
void NearestVirtualTarget::tell_gaps(const core::Pose2& pose, const core::Vec2& target_odom,
                                     domain::Inside& inside) const {
  std::vector<double> free_m;
  for (std::size_t i = 0; i < regions_.size(); ++i) free_m.push_back(regions_.free_m(i));
  inside.values.list("free_by_direction", std::move(free_m), "m");
  if (!state_.has_gap) {
    inside.say("No direction is free, so it turns on the spot toward the target.");
    return;
  }
  const double target_rad = core::bearing_rad(pose, target_odom);
  const double depth_m = core::distance_m(pose, state_.virtual_target_odom);
  domain::PictureLayer candidates{
      "virtual targets of the gaps", domain::PictureLayer::Kind::kPoints, {}, {}};
  for (const scan::SafeRegion& gap : gaps_) {
    const double bearing_rad = gap.nearest_rad(target_rad);
    const core::Vec2 candidate =
        pose.position() + depth_m * core::direction(pose.heading_rad + bearing_rad);
    domain::InsideGroup& item = inside.values.item("safe_regions");
    item.number("right", gap.right_rad, "rad");
    item.number("width", gap.width_rad, "rad");
    item.number("depth", gap.depth_m, "m");
    item.place("virtual_target", candidate);
    item.number("path", depth_m + core::length(target_odom - candidate), "m");
    item.flag("chosen", core::length(candidate - state_.virtual_target_odom) < 1e-6);
    candidates.places_odom.push_back(candidate);
  }
  inside.picture.layers.push_back(std::move(candidates));
  inside.picture.layers.push_back({"virtual target taken",
                                   domain::PictureLayer::Kind::kGoal,
                                   {},
                                   {state_.virtual_target_odom}});
  const double path_m = depth_m + core::length(target_odom - state_.virtual_target_odom);
  inside.say(domain::say_count(gaps_.size(), "gap") + (gaps_.size() == 1 ? " is " : " are ") +
             "free for " + domain::say_metres(depth_m) + ". It takes the virtual target " +
             domain::say_bearing(core::bearing_rad(pose, state_.virtual_target_odom)) +
             ", over which the path to the target is " + domain::say_metres(path_m) + " long.");
}

/// The 15 rules of Table 1.
void NearestVirtualTarget::tell_rules(double position_rad, double distance_m,
                                      domain::Inside& inside) const {
  using Rules = VirtualTargetRules;
  domain::InsideGrid strengths{Rules::kDistances, {}, "OD: VN N M F VF", "OP: D U S", {}};
  for (std::size_t i = 0; i < Rules::kPositions; ++i) {
    for (std::size_t j = 0; j < Rules::kDistances; ++j) {
      strengths.values.push_back(rules_.position_rad.degree(i, position_rad) *
                                 rules_.distance_m.degree(j, distance_m));
    }
  }
  const auto strongest = std::max_element(strengths.values.begin(), strengths.values.end());
  strengths.marked = static_cast<std::size_t>(strongest - strengths.values.begin());
  const double strength = *strongest;
  domain::InsideGrid surface{
      kOutputs, {}, "obstacle distance, 0 to 2 m", "obstacle position, 0 to 180 degrees", {}};
  constexpr auto kLast = static_cast<double>(kOutputs - 1);
  for (std::size_t row = 0; row < kOutputs; ++row) {
    for (std::size_t column = 0; column < kOutputs; ++column) {
      surface.values.push_back(rules_
                                   .infer(core::kPi * static_cast<double>(row) / kLast,
                                          kMostDistance_m * static_cast<double>(column) / kLast)
                                   .speed_mps);
    }
  }
  surface.marked =
      static_cast<std::size_t>(position_rad / core::kPi * kLast + 0.5) * kOutputs +
      static_cast<std::size_t>(std::min(1.0, distance_m / kMostDistance_m) * kLast + 0.5);
  const Rules::Output output = rules_.infer(position_rad, distance_m);
  inside.values.number("obstacle_position", position_rad, "rad");
  inside.values.number("obstacle_distance", distance_m, "m");
  inside.values.grid("rule_strengths", std::move(strengths));
  inside.values.number("turn_rate_by_rules", output.turn_rate_radps, "radps");
  inside.values.number("speed_by_rules", output.speed_mps, "mps");
  inside.values.grid("speed_surface", std::move(surface), "mps");
  inside.say("The nearest obstacle lies " + domain::say_degrees(position_rad) +
             " off that way; the strongest rule holds to " + domain::say_percent(strength) + ".");
}

}  // namespace clew::control
