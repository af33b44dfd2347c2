// SPDX-License-Identifier: Apache-2.0
#include "random_messages.hpp"

namespace clew::bridge {

using namespace clew::domain;

double RandomMessages::number(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine_);
}

std::uint32_t RandomMessages::count(std::size_t last) {
  return std::uniform_int_distribution<std::uint32_t>(0, static_cast<std::uint32_t>(last))(engine_);
}

std::string RandomMessages::text(std::size_t bound) {
  std::string text(count(bound), ' ');
  for (char& c : text) c = static_cast<char>('a' + count(25));
  return text;
}

void RandomMessages::fill(TickStamp& stamp) {
  stamp.tick = (static_cast<std::uint64_t>(count(9)) << 40) + count(1000);
  stamp.sim_time_s = number(0.0, 1e6);
  stamp.sequence = stamp.tick + 1 + count(1000);
}

void RandomMessages::fill(Pose2& pose) {
  pose = {number(-50.0, 50.0), number(-50.0, 50.0), number(-3.1, 3.1)};
}

void RandomMessages::fill(Motion& motion) {
  motion = {};
  motion.kind = static_cast<CommandKind>(count(4));
  if (motion.kind == CommandKind::kTurnAndStep) {
    motion.turn_rad = number(-3.1, 3.1);
    motion.step_m = number(0.0, 1.0);
  } else if (motion.kind == CommandKind::kVelocities) {
    motion.speed_mps = number(-1.0, 1.0);
    motion.turn_rate_radps = number(-9.0, 9.0);
  } else if (motion.kind == CommandKind::kWheelSpeeds) {
    motion.left_mps = number(-1.0, 1.0);
    motion.right_mps = number(-1.0, 1.0);
  }
}

void RandomMessages::fill(EventEntry& entry) {
  entry.kind = static_cast<EventKind>(count(7));
  entry.shadow = coin();
  entry.rule = text(kMaxNameLength);
  entry.x_m = number(-50.0, 50.0);
  entry.y_m = number(-50.0, 50.0);
  entry.has_earlier = coin();
  entry.earlier_tick = count(100000);
  entry.earlier_x_m = number(-50.0, 50.0);
  entry.earlier_y_m = number(-50.0, 50.0);
  entry.cell = count(1000);
  entry.travel_m = number(0.0, 500.0);
  entry.text = text(kMaxTextLength);
}

void RandomMessages::fill(Command& m) {
  fill(m.stamp);
  fill(m.motion);
}

void RandomMessages::fill(Event& m) {
  fill(m.stamp);
  m.entries.resize(count(kMaxEventEntries));
  for (EventEntry& entry : m.entries) fill(entry);
}

void RandomMessages::fill(Guidance& m) {
  fill(m.stamp);
  m.target_x_m = number(-50.0, 50.0);
  m.target_y_m = number(-50.0, 50.0);
  m.target_is_virtual = coin();
  m.mode = static_cast<GuidanceMode>(count(2));
  m.has_override = coin();
  fill(m.override_motion);
  m.virtual_obstacles.resize(count(kMaxVirtualObstacles));
  for (VirtualObstacle& box : m.virtual_obstacles) {
    box = {number(-50.0, 0.0), number(-50.0, 0.0), number(0.0, 50.0), number(0.0, 50.0)};
  }
  m.why = text(kMaxTextLength);
}

void RandomMessages::fill(Landmark& m) {
  fill(m.stamp);
  m.spatial_class = static_cast<std::uint8_t>(count(8));
  m.run_length = count(1000);
  m.presented = coin();
  for (std::uint8_t& c : m.classes) c = static_cast<std::uint8_t>(count(8));
  for (std::uint32_t& length : m.run_lengths) length = count(1000);
  m.recognitions.resize(count(4));
  for (Recognition& r : m.recognitions) {
    r.network = coin() ? Network::kSom : Network::kFuzzyArt;
    r.neuron = count(48);
    r.created = coin();
    for (double& c : r.prototype_classes) c = number(0.0, 8.0);
  }
}

void RandomMessages::fill(Odometry& m) {
  fill(m.stamp);
  fill(m.pose_odom_robot);
  m.speed_mps = number(-1.0, 1.0);
  m.turn_rate_radps = number(-9.0, 9.0);
  m.travel_m = number(0.0, 500.0);
  m.blocked = coin();
  m.contact_bearings_rad.resize(count(kMaxContacts));
  for (double& bearing : m.contact_bearings_rad) bearing = number(-3.1, 3.1);
}

void RandomMessages::fill(Scan& m) {
  fill(m.stamp);
  m.bearing_first_rad = number(-6.0, 6.0);
  m.bearing_step_rad = number(-6.0, 6.0);
  m.beam_width_rad = number(0.0, 6.0);
  m.range_min_m = number(0.0, 0.1);
  m.range_max_m = number(1.0, 30.0);
  m.ranges_m.resize(count(kMaxRanges));
  for (double& range : m.ranges_m) range = number(0.0, m.range_max_m);
}

void RandomMessages::fill(State& m) {
  fill(m.stamp);
  fill(m.pose_world_robot);
  m.speed_mps = number(-1.0, 1.0);
  m.turn_rate_radps = number(-9.0, 9.0);
  m.path_length_m = number(0.0, 500.0);
  m.outcome = static_cast<Outcome>(count(4));
  m.command_late = coin();
  m.collisions = count(1000);
  m.hit_by = count(1000);
  m.safety_stops = count(1000);
}

void RandomMessages::fill(Target& m) {
  fill(m.stamp);
  m.x_m = number(-50.0, 50.0);
  m.y_m = number(-50.0, 50.0);
  m.radius_m = number(0.0, 1.0);
}

}  // namespace clew::bridge
