// SPDX-License-Identifier: Apache-2.0
/// The members of every message by their names in idl/, in its order, for whoever shows or compares
/// messages without knowing them:
///
///     template <typename Member> void MyVisitor::operator()(const char* name, Member& member);
///
///     visit_named_fields(my_visitor, scan);
///
/// A member is a number, a truth value, an enumerator, a text, a list or an array of those or of
/// structs, or a struct, which has a visit_named_fields of its own.
#pragma once

#include "domain/messages.hpp"

namespace clew::bridge {

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::TickStamp& m) {
  visit("tick", m.tick);
  visit("sim_time_s", m.sim_time_s);
  visit("sequence_number", m.sequence);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Pose2& m) {
  visit("x_m", m.x_m);
  visit("y_m", m.y_m);
  visit("heading_rad", m.heading_rad);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Motion& m) {
  visit("kind", m.kind);
  visit("turn_rad", m.turn_rad);
  visit("step_m", m.step_m);
  visit("speed_mps", m.speed_mps);
  visit("turn_rate_radps", m.turn_rate_radps);
  visit("left_mps", m.left_mps);
  visit("right_mps", m.right_mps);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::EventEntry& m) {
  visit("kind", m.kind);
  visit("shadow", m.shadow);
  visit("rule", m.rule);
  visit("x_m", m.x_m);
  visit("y_m", m.y_m);
  visit("has_earlier", m.has_earlier);
  visit("earlier_tick", m.earlier_tick);
  visit("earlier_x_m", m.earlier_x_m);
  visit("earlier_y_m", m.earlier_y_m);
  visit("cell", m.cell);
  visit("travel_m", m.travel_m);
  visit("text", m.text);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::VirtualObstacle& m) {
  visit("x_min_m", m.x_min_m);
  visit("y_min_m", m.y_min_m);
  visit("x_max_m", m.x_max_m);
  visit("y_max_m", m.y_max_m);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Recognition& m) {
  visit("network", m.network);
  visit("neuron", m.neuron);
  visit("created", m.created);
  visit("prototype_classes", m.prototype_classes);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Command& m) {
  visit("stamp", m.stamp);
  visit("motion", m.motion);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Event& m) {
  visit("stamp", m.stamp);
  visit("entries", m.entries);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Guidance& m) {
  visit("stamp", m.stamp);
  visit("target_x_m", m.target_x_m);
  visit("target_y_m", m.target_y_m);
  visit("target_is_virtual", m.target_is_virtual);
  visit("mode", m.mode);
  visit("has_override", m.has_override);
  visit("override_motion", m.override_motion);
  visit("virtual_obstacles", m.virtual_obstacles);
  visit("why", m.why);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Landmark& m) {
  visit("stamp", m.stamp);
  visit("spatial_class", m.spatial_class);
  visit("run_length", m.run_length);
  visit("presented", m.presented);
  visit("classes", m.classes);
  visit("run_lengths", m.run_lengths);
  visit("recognitions", m.recognitions);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Odometry& m) {
  visit("stamp", m.stamp);
  visit("pose_odom_robot", m.pose_odom_robot);
  visit("speed_mps", m.speed_mps);
  visit("turn_rate_radps", m.turn_rate_radps);
  visit("travel_m", m.travel_m);
  visit("blocked", m.blocked);
  visit("contact_bearings_rad", m.contact_bearings_rad);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Scan& m) {
  visit("stamp", m.stamp);
  visit("bearing_first_rad", m.bearing_first_rad);
  visit("bearing_step_rad", m.bearing_step_rad);
  visit("beam_width_rad", m.beam_width_rad);
  visit("range_min_m", m.range_min_m);
  visit("range_max_m", m.range_max_m);
  visit("ranges_m", m.ranges_m);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::State& m) {
  visit("stamp", m.stamp);
  visit("pose_world_robot", m.pose_world_robot);
  visit("speed_mps", m.speed_mps);
  visit("turn_rate_radps", m.turn_rate_radps);
  visit("path_length_m", m.path_length_m);
  visit("outcome", m.outcome);
  visit("command_late", m.command_late);
  visit("collisions", m.collisions);
  visit("hit_by", m.hit_by);
  visit("safety_stops", m.safety_stops);
}

template <typename Visitor>
void visit_named_fields(Visitor& visit, domain::Target& m) {
  visit("stamp", m.stamp);
  visit("x_m", m.x_m);
  visit("y_m", m.y_m);
  visit("radius_m", m.radius_m);
}

}  // namespace clew::bridge
