// SPDX-License-Identifier: Apache-2.0
/// The values on the arrows of the graph: one struct a topic. They mirror idl/ field by field, and
/// domain/message_fields.hpp lists the fields.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/bounded_vector.hpp"
#include "core/geometry.hpp"

namespace clew::domain {

using core::Pose2;

/// When a sample was made: set by the runtime, never by a behaviour.
struct TickStamp {
  std::uint64_t tick = 0;
  double sim_time_s = 0.0;
  std::uint64_t sequence = 0;  ///< of this topic, from 0
};

enum class Outcome : std::uint8_t { kRunning, kReached, kCollided, kUnreachable, kTimeout };

/// The truth about the robot at the start of a tick. For sensing and for judging, never for a
/// behaviour's decisions.
struct State {
  TickStamp stamp;
  Pose2 pose_world_robot;
  double speed_mps = 0.0;        ///< over the tick that ended, along the heading
  double turn_rate_radps = 0.0;  ///< over the tick that ended
  double path_length_m = 0.0;    ///< travelled since tick 0
  Outcome outcome = Outcome::kRunning;
  bool command_late = false;       ///< the command of the tick that ended came too late
  std::uint32_t collisions = 0;    ///< contacts that the robot moved into, since tick 0
  std::uint32_t hit_by = 0;        ///< contacts that a moving obstacle made, since tick 0
  std::uint32_t safety_stops = 0;  ///< interventions of the safety layer, since tick 0
};

inline constexpr std::size_t kMaxContacts = 8;

/// How far a pose may be off: the covariance of its x, y and heading, symmetric; all 0: it is
/// exact.
struct PoseCovariance {
  double x_m2 = 0.0;
  double xy_m2 = 0.0;
  double x_heading_m_rad = 0.0;
  double y_m2 = 0.0;
  double y_heading_m_rad = 0.0;
  double heading_rad2 = 0.0;
};

template <typename Visitor>
void visit_fields(Visitor& visit, PoseCovariance& c) {
  visit(c.x_m2, c.xy_m2, c.x_heading_m_rad, c.y_m2, c.y_heading_m_rad, c.heading_rad2);
}

/// What the robot's own wheels and bumpers tell at the start of a tick.
struct Odometry {
  TickStamp stamp;
  Pose2 pose_odom_robot;
  PoseCovariance covariance;  ///< of pose_odom_robot, by the drive's own drift parameters
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
  double travel_m = 0.0;  ///< path length by the wheels, since tick 0
  bool blocked = false;   ///< the last command was cut short by contact, or would have been
  /// Directions of the contacts of the last command, in the robot's frame as it stands now.
  core::BoundedVector<double, kMaxContacts> contact_bearings_rad;
};

/// Where the mission wants the robot's centre, in the odometry frame.
struct Target {
  TickStamp stamp;
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 0.0;     ///< arrival within this distance
  bool has_heading = false;  ///< arrival is also within a tolerance of a heading
  double heading_rad = 0.0;
  double heading_tolerance_rad = 0.0;  ///< on each side
  std::uint32_t waypoint = 0;          ///< that it is on the way to, from 1; 0: no mission
  std::uint32_t waypoints = 0;         ///< how many the mission has

  core::Vec2 position() const { return {x_m, y_m}; }
};

inline constexpr std::size_t kMaxRanges = 2048;

/// One sweep of the range sensors. Beam i points at bearing_first_rad + i * bearing_step_rad from
/// the heading. A range is measured from the robot's skin: distance from its centre less its
/// radius, 0 at contact; range_max_m means that nothing is within range.
struct Scan {
  TickStamp stamp;
  double bearing_first_rad = 0.0;
  double bearing_step_rad = 0.0;
  double beam_width_rad = 0.0;  ///< full opening of a beam; 0 for a ray
  double range_min_m = 0.0;     ///< below this the sensor cannot measure
  double range_max_m = 0.0;
  std::vector<double> ranges_m;  ///< N <= kMaxRanges, each in [0, range_max_m]

  double bearing_rad(std::size_t i) const {
    return bearing_first_rad + static_cast<double>(i) * bearing_step_rad;
  }
};

enum class Network : std::uint8_t { kSom, kFuzzyArt };

/// A network's answer to a presented landmark vector.
struct Recognition {
  Network network = Network::kSom;
  std::uint32_t neuron = 0;  ///< row-major in the lattice (SOM), or the category's number (ART)
  bool created = false;      ///< a category that was made just now
  std::array<double, 3> prototype_classes{};  ///< what the winner stands for, in classes 0..8
};

/// What the classifier knows of the place: Krishna & Kalra 2000, section 3.
struct Landmark {
  TickStamp stamp;
  std::uint8_t spatial_class = 8;  ///< 0..8, Table I
  std::uint32_t run_length = 0;    ///< ticks that this class has lasted, this one included
  bool presented = false;          ///< a landmark vector was presented to the networks this tick
  std::array<std::uint8_t, 3> classes{};             ///< the presented vector, oldest first
  std::array<std::uint32_t, 3> run_lengths{};        ///< how long each lasted, in ticks
  core::BoundedVector<Recognition, 4> recognitions;  ///< who knew it
};

enum class CommandKind : std::uint8_t {
  kStop,         ///< stay
  kTurnAndStep,  ///< turn_rad on the spot, then step_m ahead
  kVelocities,   ///< speed_mps and turn_rate_radps for a tick
  kWheelSpeeds,  ///< left_mps and right_mps for a tick
  kGiveUp        ///< stay, and end the mission: the target is unreachable
};

/// A motion for one tick. Numbers that the kind does not use are 0.
struct Motion {
  CommandKind kind = CommandKind::kStop;
  double turn_rad = 0.0;
  double step_m = 0.0;
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
  double left_mps = 0.0;
  double right_mps = 0.0;
};

/// A place that a controller steers for instead of the target in force, in the odometry frame.
struct VirtualTarget {
  double x_m = 0.0;
  double y_m = 0.0;
};

inline constexpr std::size_t kMaxVirtualTargets = 8;

struct Command {
  TickStamp stamp;
  Motion motion;
  /// Those in force that the controller set by itself, in the order in which they were set.
  core::BoundedVector<VirtualTarget, kMaxVirtualTargets> virtual_targets;
};

enum class GuidanceMode : std::uint8_t { kSeek, kRecover, kUnreachable };

/// An axis-aligned box in the odometry frame that the controller must treat as an obstacle.
struct VirtualObstacle {
  double x_min_m = 0.0;
  double y_min_m = 0.0;
  double x_max_m = 0.0;
  double y_max_m = 0.0;
};

template <typename Visitor>
void visit_fields(Visitor& visit, VirtualObstacle& o) {
  visit(o.x_min_m, o.y_min_m, o.x_max_m, o.y_max_m);
}

inline constexpr std::size_t kMaxVirtualObstacles = 16;
inline constexpr std::size_t kMaxTextLength = 96;
inline constexpr std::size_t kMaxNameLength = 48;

/// What recovery asks of control: the active target, obstacles to imagine, or a motion instead.
struct Guidance {
  TickStamp stamp;
  double target_x_m = 0.0;
  double target_y_m = 0.0;
  bool target_is_virtual = false;
  double target_radius_m = 0.0;  ///< arrival; 0 if it is virtual
  /// As of Target; a virtual target has no heading.
  bool target_has_heading = false;
  double target_heading_rad = 0.0;
  double target_heading_tolerance_rad = 0.0;
  GuidanceMode mode = GuidanceMode::kSeek;
  bool has_override = false;
  Motion override_motion;  ///< in force if has_override
  core::BoundedVector<VirtualObstacle, kMaxVirtualObstacles> virtual_obstacles;
  std::string why;  ///< at most kMaxTextLength bytes, for people
};

enum class EventKind : std::uint8_t {
  kLandmark,  ///< a landmark was recognised
  kReflex,    ///< immediate memory acted
  kTrap,      ///< a detector says trap
  kEscapeBegun,
  kEscapeEnded,    ///< the escape let go: the way is open
  kEscapeFailed,   ///< the escape gave up
  kVirtualTarget,  ///< a virtual target was set
  kUnreachable
};

/// Something that a person would mark on the picture of the path.
struct EventEntry {
  EventKind kind = EventKind::kLandmark;
  bool shadow = false;  ///< a detector that only watches
  std::string rule;     ///< the behaviour that speaks, at most kMaxNameLength bytes
  double x_m = 0.0;     ///< place, odometry frame
  double y_m = 0.0;
  bool has_earlier = false;  ///< the next five tell of the earlier visit that proves a trap
  std::uint64_t earlier_tick = 0;
  double earlier_x_m = 0.0;
  double earlier_y_m = 0.0;
  std::uint32_t cell = 0;  ///< neuron, category or grid cell
  double travel_m = 0.0;   ///< path between the two visits
  std::string text;        ///< at most kMaxTextLength bytes
};

inline constexpr std::size_t kMaxEventEntries = 8;

struct Event {
  TickStamp stamp;
  core::BoundedVector<EventEntry, kMaxEventEntries> entries;
};

}  // namespace clew::domain
