// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tuple>

#include "domain/messages.hpp"

namespace clew::domain {

inline auto fields(const TickStamp& m) { return std::tie(m.tick, m.sim_time_s, m.sequence); }
inline auto fields(const Motion& m) {
  return std::tie(m.kind, m.turn_rad, m.step_m, m.speed_mps, m.turn_rate_radps, m.left_mps,
                  m.right_mps);
}
inline auto fields(const VirtualObstacle& m) {
  return std::tie(m.x_min_m, m.y_min_m, m.x_max_m, m.y_max_m);
}
inline auto fields(const Recognition& m) {
  return std::tie(m.network, m.neuron, m.created, m.prototype_classes);
}
inline auto fields(const EventEntry& m) {
  return std::tie(m.kind, m.shadow, m.rule, m.x_m, m.y_m, m.has_earlier, m.earlier_tick,
                  m.earlier_x_m, m.earlier_y_m, m.cell, m.travel_m, m.text);
}
inline auto fields(const Command& m) { return std::tie(m.stamp, m.motion); }
inline auto fields(const Event& m) { return std::tie(m.stamp, m.entries); }
inline auto fields(const Guidance& m) {
  return std::tie(m.stamp, m.target_x_m, m.target_y_m, m.target_is_virtual, m.mode, m.has_override,
                  m.override_motion, m.virtual_obstacles, m.why);
}
inline auto fields(const Landmark& m) {
  return std::tie(m.stamp, m.spatial_class, m.run_length, m.presented, m.classes, m.run_lengths,
                  m.recognitions);
}
inline auto fields(const Odometry& m) {
  return std::tie(m.stamp, m.pose_odom_robot, m.speed_mps, m.turn_rate_radps, m.travel_m, m.blocked,
                  m.contact_bearings_rad);
}
inline auto fields(const Scan& m) {
  return std::tie(m.stamp, m.bearing_first_rad, m.bearing_step_rad, m.beam_width_rad, m.range_min_m,
                  m.range_max_m, m.ranges_m);
}
inline auto fields(const State& m) {
  return std::tie(m.stamp, m.pose_world_robot, m.speed_mps, m.turn_rate_radps, m.path_length_m,
                  m.outcome, m.command_late, m.collisions, m.hit_by, m.safety_stops);
}
inline auto fields(const Target& m) { return std::tie(m.stamp, m.x_m, m.y_m, m.radius_m); }

/// Messages are equal if all their fields are, bit for bit but for the sign of zero.
template <typename Message>
auto operator==(const Message& a, const Message& b) -> decltype(fields(a) == fields(b)) {
  return fields(a) == fields(b);
}

}  // namespace clew::domain
