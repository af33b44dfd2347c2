// SPDX-License-Identifier: Apache-2.0
#include "message_json.hpp"

#include <string>

namespace clew::recording_test {

using nlohmann::json;

namespace {

json to_json(const domain::TickStamp& stamp) {
  return {{"tick", std::to_string(stamp.tick)},
          {"sim_time_s", stamp.sim_time_s},
          {"sequence_number", std::to_string(stamp.sequence)}};
}

json to_json(const domain::Pose2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.heading_rad}};
}

json to_json(const domain::Motion& motion) {
  return {{"kind", static_cast<int>(motion.kind)},
          {"turn_rad", motion.turn_rad},
          {"step_m", motion.step_m},
          {"speed_mps", motion.speed_mps},
          {"turn_rate_radps", motion.turn_rate_radps},
          {"left_mps", motion.left_mps},
          {"right_mps", motion.right_mps}};
}

json to_json(const domain::EventEntry& entry) {
  return {{"kind", static_cast<int>(entry.kind)},
          {"shadow", entry.shadow},
          {"rule", entry.rule},
          {"x_m", entry.x_m},
          {"y_m", entry.y_m},
          {"has_earlier", entry.has_earlier},
          {"earlier_tick", std::to_string(entry.earlier_tick)},
          {"earlier_x_m", entry.earlier_x_m},
          {"earlier_y_m", entry.earlier_y_m},
          {"cell", entry.cell},
          {"travel_m", entry.travel_m},
          {"text", entry.text}};
}

json to_json(const domain::VirtualObstacle& box) {
  return {{"x_min_m", box.x_min_m},
          {"y_min_m", box.y_min_m},
          {"x_max_m", box.x_max_m},
          {"y_max_m", box.y_max_m}};
}

json to_json(const domain::Recognition& recognition) {
  return {{"network", static_cast<int>(recognition.network)},
          {"neuron", recognition.neuron},
          {"created", recognition.created},
          {"prototype_classes", recognition.prototype_classes}};
}

json to_json(double value) { return value; }

template <typename List>
json list_json(const List& list) {
  json items = json::array();
  for (const auto& item : list) items.push_back(to_json(item));
  return items;
}

}  // namespace

json to_json(const domain::Command& m) {
  return {{"stamp", to_json(m.stamp)}, {"motion", to_json(m.motion)}};
}

json to_json(const domain::Event& m) {
  return {{"stamp", to_json(m.stamp)}, {"entries", list_json(m.entries)}};
}

json to_json(const domain::Guidance& m) {
  return {{"stamp", to_json(m.stamp)},
          {"target_x_m", m.target_x_m},
          {"target_y_m", m.target_y_m},
          {"target_is_virtual", m.target_is_virtual},
          {"mode", static_cast<int>(m.mode)},
          {"has_override", m.has_override},
          {"override_motion", to_json(m.override_motion)},
          {"virtual_obstacles", list_json(m.virtual_obstacles)},
          {"why", m.why}};
}

json to_json(const domain::Landmark& m) {
  return {{"stamp", to_json(m.stamp)},
          {"spatial_class", m.spatial_class},
          {"run_length", m.run_length},
          {"presented", m.presented},
          {"classes", m.classes},
          {"run_lengths", m.run_lengths},
          {"recognitions", list_json(m.recognitions)}};
}

json to_json(const domain::Odometry& m) {
  return {{"stamp", to_json(m.stamp)},
          {"pose_odom_robot", to_json(m.pose_odom_robot)},
          {"speed_mps", m.speed_mps},
          {"turn_rate_radps", m.turn_rate_radps},
          {"travel_m", m.travel_m},
          {"blocked", m.blocked},
          {"contact_bearings_rad", list_json(m.contact_bearings_rad)}};
}

json to_json(const domain::Scan& m) {
  return {{"stamp", to_json(m.stamp)},
          {"bearing_first_rad", m.bearing_first_rad},
          {"bearing_step_rad", m.bearing_step_rad},
          {"beam_width_rad", m.beam_width_rad},
          {"range_min_m", m.range_min_m},
          {"range_max_m", m.range_max_m},
          {"ranges_m", list_json(m.ranges_m)}};
}

json to_json(const domain::State& m) {
  return {{"stamp", to_json(m.stamp)},
          {"pose_world_robot", to_json(m.pose_world_robot)},
          {"speed_mps", m.speed_mps},
          {"turn_rate_radps", m.turn_rate_radps},
          {"path_length_m", m.path_length_m},
          {"outcome", static_cast<int>(m.outcome)},
          {"command_late", m.command_late},
          {"collisions", m.collisions},
          {"hit_by", m.hit_by},
          {"safety_stops", m.safety_stops}};
}

json to_json(const domain::Target& m) {
  return {{"stamp", to_json(m.stamp)}, {"x_m", m.x_m}, {"y_m", m.y_m}, {"radius_m", m.radius_m}};
}

}  // namespace clew::recording_test
