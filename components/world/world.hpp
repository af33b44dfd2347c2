// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/bounded_vector.hpp"
#include "core/geometry.hpp"
#include "core/result.hpp"

namespace clew::world {

using core::Pose2;
using core::Vec2;

/// A disc that moves along a polyline, linear in time between the points; or that jumps from one to
/// the next.
struct MovingObstacle {
  struct Waypoint {
    double time_s = 0.0;
    Vec2 position = Vec2::Zero();
  };
  double radius_m = 0.0;
  std::vector<Waypoint> path;  ///< at least one; times rise from 0
  bool loop = false;           ///< wraps at the last time, else stays there
  /// Stands at each point until after the time of the next: at that time itself it is not yet
  /// there. So other robots are known, a tick at a time; see bridge/fleet.
  bool jumps = false;
  std::uint32_t entry = 0;  ///< of the file's list; a shape of several discs is one

  Vec2 position_at(double time_s) const;
};

/// How far a disc gets on a straight way.
struct Sweep {
  double free_fraction = 1.0;  ///< of the way, 0..1; 1 means no contact before its end
  bool contact = false;
  Vec2 contact_point = Vec2::Zero();  ///< on the obstacle, where the disc touches; if contact
  bool moving_obstacle = false;       ///< the obstacle touched moves
};

/// Which way a cone looks and how wide it is. It is made with four sines and cosines and turned
/// without any, so a sensor makes its cones once and turns them with the robot.
struct ConeDirection {
  Vec2 axis = Vec2::UnitX();        ///< unit vector
  Vec2 half_angle = Vec2::UnitX();  ///< cosine and sine

  /// half_angle_rad in [0, pi/2); 0 is a ray.
  static ConeDirection of(double bearing_rad, double half_angle_rad);
  /// Turned counter-clockwise by the angle whose unit vector is `turn`: a cone of the robot's frame
  /// into the world's frame, if `turn` is core::direction of its heading.
  ConeDirection turned(const Vec2& turn) const;
};

class RayFan;

/// How a robot is to stand at a place: arrival is with a heading within the tolerance, too.
struct GoalHeading {
  static constexpr double kTolerance_rad = 0.1;  ///< where none is named

  double heading_rad = 0.0;               ///< in (-pi, pi], world and odometry frame
  double tolerance_rad = kTolerance_rad;  ///< on each side, in (0, pi]

  bool is_met_by(double robot_heading_rad) const;
};

/// A place that a run is to lead to.
struct Goal {
  Vec2 place = Vec2::Zero();
  std::optional<double> radius_m;  ///< arrival is within it; none: the world's target radius
  std::optional<GoalHeading> heading = std::nullopt;  ///< none: any
};

/// The places of a run in their order, instead of those that its world file names: it ends at the
/// last. None at all: the robot waits where it is.
using Goals = std::vector<Goal>;
/// No more than this of them.
inline constexpr std::size_t kMostGoals = 256;

/// A place on the way of a mission: the next one follows when the robot is within the radius, and
/// has the heading if one is named.
struct Waypoint {
  Vec2 place = Vec2::Zero();
  double radius_m = 0.0;
  std::optional<GoalHeading> heading = std::nullopt;  ///< none: any

  /// Whether a robot that stands so has arrived.
  bool is_reached_by(const Pose2& robot) const;
};

/// A world file (`clew-world/1`), checked and indexed for queries. Immutable, but for place_moving;
/// safe to share between threads. Obstacles are the boundary, walls, polygons and circles (filled),
/// and moving discs; all queries take the simulated time, which only moving ones need.
class World {
 public:
  /// Reads a world from YAML. `file` is named in errors. Refused, with file, line and what is
  /// allowed: broken YAML, another format, unknown, missing or duplicate keys, wrong types, numbers
  /// that are not finite, empty bounds, start, target or way-point outside or inside an obstacle,
  /// radii that are not positive, polygons that cross themselves, times that do not rise.
  static core::Result<World> parse(std::string_view yaml, const std::string& file);
  /// The same with other goals: nothing is known of the way there, and the file's subgoals are none
  /// of it. Refused, too: a goal where the file's target could not lie.
  static core::Result<World> parse(std::string_view yaml, const std::string& file,
                                   const std::optional<Goals>& goals);

  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  const std::string& name() const;
  const std::string& about() const;
  /// Lower left and upper right corner of the closed boundary.
  const Vec2& bounds_min() const;
  const Vec2& bounds_max() const;
  const Pose2& start() const;
  /// The last of the way-points; without any, the file's.
  const Vec2& target() const;
  double target_radius_m() const;
  const std::optional<GoalHeading>& target_heading() const;
  /// The mission: the way-points in their order, and the target behind them. Empty: the robot
  /// waits.
  const std::vector<Waypoint>& waypoints() const;
  const std::vector<Vec2>& subgoals() const;
  std::optional<bool> solvable() const;
  std::optional<double> shortest_path_m() const;

  /// Puts an obstacle of moving() at the first point of its path, and nowhere else: for whoever
  /// knows where it is only as time goes on. Nobody else may look at the world meanwhile.
  void place_moving(std::size_t index, const Vec2& place);

  /// Whether a disc of this radius stands free at the start at time 0; else the error names the
  /// obstacle and its distance, and the place of the start in the file.
  core::Result<void> check_robot_fits(double radius_m) const;

  // As in the file, for drawing.
  struct Segment {
    Vec2 a = Vec2::Zero();
    Vec2 b = Vec2::Zero();
  };
  struct Circle {
    Vec2 centre = Vec2::Zero();
    double radius_m = 0.0;
  };
  const std::vector<Segment>& walls() const;
  const std::vector<std::vector<Vec2>>& polygons() const;
  const std::vector<Circle>& circles() const;
  const std::vector<MovingObstacle>& moving() const;

  /// Least distance from `apex` to anything inside the cone |angle from bearing_rad| <=
  /// half_angle_rad, exact for segments, arcs and polygons: nearest point of the clipped geometry.
  /// At most max_distance_m, which means that nothing is nearer; 0 inside an obstacle.
  /// half_angle_rad in [0, pi/2); 0 is a ray. bearing_rad in the world's frame.
  double cone_distance_m(const Vec2& apex, double bearing_rad, double half_angle_rad,
                         double max_distance_m, double time_s) const;
  double cone_distance_m(const Vec2& apex, const ConeDirection& cone, double max_distance_m,
                         double time_s) const;

  /// Fills distances_m[i] with cone_distance_m along ray i of a fan on a robot at `pose`, bit for
  /// bit, at a fraction of the cost: each obstacle within reach is looked at once.
  void fan_distances_m(const Pose2& pose, const RayFan& fan, double max_distance_m, double time_s,
                       std::vector<double>& distances_m) const;

  /// The two walls' corner that a sonar in this cone would look into, if any: an inner corner
  /// (where a segment ends on another, within 1 mm, at less than 180 degrees on the side of the
  /// apex) inside the cone and nearer than max_distance_m; returns its distance. What hides the
  /// corner is not looked at: compare with cone_distance_m. For modelling multiple reflection.
  std::optional<double> corner_distance_m(const Vec2& apex, double bearing_rad,
                                          double half_angle_rad, double max_distance_m) const;

  /// Distance from `point` to the nearest obstacle's surface; 0 inside one. Capped at
  /// max_distance_m.
  double clearance_m(const Vec2& point, double max_distance_m, double time_s) const;
  /// The same of what does not move: what a map can know.
  double standing_clearance_m(const Vec2& point, double max_distance_m) const;

  /// Moves a disc of `radius_m` from `from` to `to` during [time_s, time_s + duration_s], obstacles
  /// moving meanwhile. Touching at the start and moving away, or along, is no contact; touching and
  /// moving in gives a free_fraction of 0. It stops 1e-9 m before an obstacle, so rounding never
  /// makes it overlap.
  Sweep sweep_disc(const Vec2& from, const Vec2& to, double radius_m, double time_s,
                   double duration_s) const;

  /// Directions (world frame, radians) from `centre` to the points of obstacles that a disc of
  /// radius_m + tolerance_m there touches, nearest first; at most 8, one a point touched: two in a
  /// corner, one at a polygon's vertex.
  core::BoundedVector<double, 8> contacts_rad(const Vec2& centre, double radius_m,
                                              double tolerance_m, double time_s) const;

 private:
  struct Content;
  explicit World(std::unique_ptr<Content> content);
  std::unique_ptr<Content> content_;
};

}  // namespace clew::world
