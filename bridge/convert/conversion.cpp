// SPDX-License-Identifier: Apache-2.0
#include "convert/conversion.hpp"

#include <algorithm>

#include "convert/enumerators.hpp"

namespace clew::bridge {
namespace {

void to_idl(const domain::TickStamp& from, msg::TickStamp& to) {
  to.tick(from.tick);
  to.sim_time_s(from.sim_time_s);
  to.sequence_number(from.sequence);
}

void from_idl(const msg::TickStamp& from, domain::TickStamp& to) {
  to.tick = from.tick();
  to.sim_time_s = from.sim_time_s();
  to.sequence = from.sequence_number();
}

void to_idl(const domain::Pose2& from, msg::Pose2& to) {
  to.x_m(from.x_m);
  to.y_m(from.y_m);
  to.heading_rad(from.heading_rad);
}

void from_idl(const msg::Pose2& from, domain::Pose2& to) {
  to.x_m = from.x_m();
  to.y_m = from.y_m();
  to.heading_rad = from.heading_rad();
}

void to_idl(const domain::Motion& from, msg::TickMotion& to) {
  to.kind(enum_to_idl<msg::CommandKind>(from.kind));
  to.turn_rad(from.turn_rad);
  to.step_m(from.step_m);
  to.speed_mps(from.speed_mps);
  to.turn_rate_radps(from.turn_rate_radps);
  to.left_mps(from.left_mps);
  to.right_mps(from.right_mps);
}

void from_idl(const msg::TickMotion& from, domain::Motion& to, const char* name,
              domain::FieldCheck& check) {
  to.kind = enum_from_idl(from.kind(), CommandKind::kGiveUp, {name, "kind"}, check);
  to.turn_rad = from.turn_rad();
  to.step_m = from.step_m();
  to.speed_mps = from.speed_mps();
  to.turn_rate_radps = from.turn_rate_radps();
  to.left_mps = from.left_mps();
  to.right_mps = from.right_mps();
}

void to_idl(const domain::EventEntry& from, msg::EventEntry& to) {
  to.kind(enum_to_idl<msg::EventKind>(from.kind));
  to.shadow(from.shadow);
  to.rule() = from.rule;
  to.x_m(from.x_m);
  to.y_m(from.y_m);
  to.has_earlier(from.has_earlier);
  to.earlier_tick(from.earlier_tick);
  to.earlier_x_m(from.earlier_x_m);
  to.earlier_y_m(from.earlier_y_m);
  to.cell(from.cell);
  to.travel_m(from.travel_m);
  to.text() = from.text;
}

void from_idl(const msg::EventEntry& from, domain::EventEntry& to, std::size_t index,
              domain::FieldCheck& check) {
  to.kind = enum_from_idl(from.kind(), EventKind::kUnreachable, {"entries", index, "kind"}, check);
  to.shadow = from.shadow();
  to.rule = from.rule().c_str();
  to.x_m = from.x_m();
  to.y_m = from.y_m();
  to.has_earlier = from.has_earlier();
  to.earlier_tick = from.earlier_tick();
  to.earlier_x_m = from.earlier_x_m();
  to.earlier_y_m = from.earlier_y_m();
  to.cell = from.cell();
  to.travel_m = from.travel_m();
  to.text = from.text().c_str();
}

void to_idl(const domain::VirtualObstacle& from, msg::VirtualObstacle& to) {
  to.x_min_m(from.x_min_m);
  to.y_min_m(from.y_min_m);
  to.x_max_m(from.x_max_m);
  to.y_max_m(from.y_max_m);
}

void from_idl(const msg::VirtualObstacle& from, domain::VirtualObstacle& to) {
  to.x_min_m = from.x_min_m();
  to.y_min_m = from.y_min_m();
  to.x_max_m = from.x_max_m();
  to.y_max_m = from.y_max_m();
}

void to_idl(const domain::Recognition& from, msg::Recognition& to) {
  to.network(enum_to_idl<msg::NetworkKind>(from.network));
  to.neuron(from.neuron);
  to.created(from.created);
  to.prototype_classes(from.prototype_classes);
}

void from_idl(const msg::Recognition& from, domain::Recognition& to, std::size_t index,
              domain::FieldCheck& check) {
  to.network =
      enum_from_idl(from.network(), Network::kFuzzyArt, {"recognitions", index, "network"}, check);
  to.neuron = from.neuron();
  to.created = from.created();
  to.prototype_classes = from.prototype_classes();
}

/// Sets the size of `to` to that of `from`, or to what it can hold, with a complaint.
template <typename Idl, typename Domain, std::size_t N>
void fit(const std::vector<Idl>& from, core::BoundedVector<Domain, N>& to, const char* name,
         domain::FieldCheck& check) {
  check.size(name, from.size(), N);
  to.resize(std::min(from.size(), N));
}

}  // namespace

void to_idl(const domain::Command& from, msg::Command& to) {
  to_idl(from.stamp, to.stamp());
  to_idl(from.motion, to.motion());
}

void from_idl(const msg::Command& from, domain::Command& to, domain::FieldCheck& check) {
  from_idl(from.stamp(), to.stamp);
  from_idl(from.motion(), to.motion, "motion", check);
}

void to_idl(const domain::Event& from, msg::Event& to) {
  to_idl(from.stamp, to.stamp());
  to.entries().resize(from.entries.size());
  for (std::size_t i = 0; i < from.entries.size(); ++i) to_idl(from.entries[i], to.entries()[i]);
}

void from_idl(const msg::Event& from, domain::Event& to, domain::FieldCheck& check) {
  from_idl(from.stamp(), to.stamp);
  fit(from.entries(), to.entries, "entries", check);
  for (std::size_t i = 0; i < to.entries.size(); ++i) {
    from_idl(from.entries()[i], to.entries[i], i, check);
  }
}

void to_idl(const domain::Guidance& from, msg::Guidance& to) {
  to_idl(from.stamp, to.stamp());
  to.target_x_m(from.target_x_m);
  to.target_y_m(from.target_y_m);
  to.target_is_virtual(from.target_is_virtual);
  to.mode(enum_to_idl<msg::GuidanceMode>(from.mode));
  to.has_override(from.has_override);
  to_idl(from.override_motion, to.override_motion());
  to.virtual_obstacles().resize(from.virtual_obstacles.size());
  for (std::size_t i = 0; i < from.virtual_obstacles.size(); ++i) {
    to_idl(from.virtual_obstacles[i], to.virtual_obstacles()[i]);
  }
  to.why() = from.why;
}

void from_idl(const msg::Guidance& from, domain::Guidance& to, domain::FieldCheck& check) {
  from_idl(from.stamp(), to.stamp);
  to.target_x_m = from.target_x_m();
  to.target_y_m = from.target_y_m();
  to.target_is_virtual = from.target_is_virtual();
  to.mode = enum_from_idl(from.mode(), GuidanceMode::kUnreachable, "mode", check);
  to.has_override = from.has_override();
  from_idl(from.override_motion(), to.override_motion, "override_motion", check);
  fit(from.virtual_obstacles(), to.virtual_obstacles, "virtual_obstacles", check);
  for (std::size_t i = 0; i < to.virtual_obstacles.size(); ++i) {
    from_idl(from.virtual_obstacles()[i], to.virtual_obstacles[i]);
  }
  to.why = from.why().c_str();
}

void to_idl(const domain::Landmark& from, msg::Landmark& to) {
  to_idl(from.stamp, to.stamp());
  to.spatial_class(from.spatial_class);
  to.run_length(from.run_length);
  to.presented(from.presented);
  to.classes(from.classes);
  to.run_lengths(from.run_lengths);
  to.recognitions().resize(from.recognitions.size());
  for (std::size_t i = 0; i < from.recognitions.size(); ++i) {
    to_idl(from.recognitions[i], to.recognitions()[i]);
  }
}

void from_idl(const msg::Landmark& from, domain::Landmark& to, domain::FieldCheck& check) {
  from_idl(from.stamp(), to.stamp);
  to.spatial_class = from.spatial_class();
  to.run_length = from.run_length();
  to.presented = from.presented();
  to.classes = from.classes();
  to.run_lengths = from.run_lengths();
  fit(from.recognitions(), to.recognitions, "recognitions", check);
  for (std::size_t i = 0; i < to.recognitions.size(); ++i) {
    from_idl(from.recognitions()[i], to.recognitions[i], i, check);
  }
}

void to_idl(const domain::Odometry& from, msg::Odometry& to) {
  to_idl(from.stamp, to.stamp());
  to_idl(from.pose_odom_robot, to.pose_odom_robot());
  to.speed_mps(from.speed_mps);
  to.turn_rate_radps(from.turn_rate_radps);
  to.travel_m(from.travel_m);
  to.blocked(from.blocked);
  to.contact_bearings_rad().assign(from.contact_bearings_rad.begin(),
                                   from.contact_bearings_rad.end());
}

void from_idl(const msg::Odometry& from, domain::Odometry& to, domain::FieldCheck& check) {
  from_idl(from.stamp(), to.stamp);
  from_idl(from.pose_odom_robot(), to.pose_odom_robot);
  to.speed_mps = from.speed_mps();
  to.turn_rate_radps = from.turn_rate_radps();
  to.travel_m = from.travel_m();
  to.blocked = from.blocked();
  fit(from.contact_bearings_rad(), to.contact_bearings_rad, "contact_bearings_rad", check);
  std::copy_n(from.contact_bearings_rad().begin(), to.contact_bearings_rad.size(),
              to.contact_bearings_rad.begin());
}

void to_idl(const domain::Scan& from, msg::Scan& to) {
  to_idl(from.stamp, to.stamp());
  to.bearing_first_rad(from.bearing_first_rad);
  to.bearing_step_rad(from.bearing_step_rad);
  to.beam_width_rad(from.beam_width_rad);
  to.range_min_m(from.range_min_m);
  to.range_max_m(from.range_max_m);
  to.ranges_m(from.ranges_m);
}

void from_idl(const msg::Scan& from, domain::Scan& to, domain::FieldCheck& check) {
  from_idl(from.stamp(), to.stamp);
  to.bearing_first_rad = from.bearing_first_rad();
  to.bearing_step_rad = from.bearing_step_rad();
  to.beam_width_rad = from.beam_width_rad();
  to.range_min_m = from.range_min_m();
  to.range_max_m = from.range_max_m();
  check.size("ranges_m", from.ranges_m().size(), domain::kMaxRanges);
  to.ranges_m = from.ranges_m();
}

void to_idl(const domain::State& from, msg::State& to) {
  to_idl(from.stamp, to.stamp());
  to_idl(from.pose_world_robot, to.pose_world_robot());
  to.speed_mps(from.speed_mps);
  to.turn_rate_radps(from.turn_rate_radps);
  to.path_length_m(from.path_length_m);
  to.outcome(enum_to_idl<msg::RunOutcome>(from.outcome));
  to.command_late(from.command_late);
  to.collisions(from.collisions);
  to.hit_by(from.hit_by);
  to.safety_stops(from.safety_stops);
}

void from_idl(const msg::State& from, domain::State& to, domain::FieldCheck& check) {
  from_idl(from.stamp(), to.stamp);
  from_idl(from.pose_world_robot(), to.pose_world_robot);
  to.speed_mps = from.speed_mps();
  to.turn_rate_radps = from.turn_rate_radps();
  to.path_length_m = from.path_length_m();
  to.outcome = enum_from_idl(from.outcome(), Outcome::kTimeout, "outcome", check);
  to.command_late = from.command_late();
  to.collisions = from.collisions();
  to.hit_by = from.hit_by();
  to.safety_stops = from.safety_stops();
}

void to_idl(const domain::Target& from, msg::Target& to) {
  to_idl(from.stamp, to.stamp());
  to.x_m(from.x_m);
  to.y_m(from.y_m);
  to.radius_m(from.radius_m);
}

void from_idl(const msg::Target& from, domain::Target& to, domain::FieldCheck& /*check*/) {
  from_idl(from.stamp(), to.stamp);
  to.x_m = from.x_m();
  to.y_m = from.y_m();
  to.radius_m = from.radius_m();
}

}  // namespace clew::bridge
