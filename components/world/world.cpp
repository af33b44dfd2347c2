// SPDX-License-Identifier: Apache-2.0
#include "world/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "world/cone.hpp"
#include "world/corners.hpp"
#include "world/fan_sweep.hpp"
#include "world/nearest_obstacle.hpp"
#include "world/polygon.hpp"
#include "world/shapes.hpp"
#include "world/sweep.hpp"
#include "world/world_file.hpp"

namespace clew::world {
namespace {

// Contacts nearer to each other than this are one: two sides that share a point.
constexpr double kSamePoint_m = 1e-9;

std::vector<World::Segment> solid_segments(const WorldFile& file) {
  std::vector<World::Segment> segments = file.walls;
  for (const Polygon& polygon : file.polygons) {
    const auto edges = edges_of(polygon);
    segments.insert(segments.end(), edges.begin(), edges.end());
  }
  return segments;
}

// The nearest touching points, sorted by distance.
class Contacts {
 public:
  explicit Contacts(const Vec2& centre) : centre_(centre) {}

  void add(const Vec2& point, double distance_m) {
    for (const Contact& contact : nearest_) {
      if (distance(contact.point, point) <= kSamePoint_m) return;
    }
    if (nearest_.full()) {
      if (!(distance_m < nearest_[nearest_.size() - 1].distance_m)) return;
      nearest_.resize(nearest_.size() - 1);
    }
    nearest_.push_back({point, distance_m});
    for (std::size_t i = nearest_.size() - 1; i > 0 && before(i, i - 1); --i) {
      std::swap(nearest_[i], nearest_[i - 1]);
    }
  }

  core::BoundedVector<double, 8> bearings_rad() const {
    core::BoundedVector<double, 8> bearings;
    for (const Contact& contact : nearest_) {
      bearings.push_back(core::bearing_rad({centre_.x(), centre_.y(), 0.0}, contact.point));
    }
    return bearings;
  }

 private:
  struct Contact {
    Vec2 point = Vec2::Zero();
    double distance_m = 0.0;
  };
  // By distance; the point decides between equals, so that the order is that of the world, not of
  // the tree.
  bool before(std::size_t i, std::size_t j) const {
    const Contact& a = nearest_[i];
    const Contact& b = nearest_[j];
    if (a.distance_m != b.distance_m) return a.distance_m < b.distance_m;
    return a.point.x() != b.point.x() ? a.point.x() < b.point.x() : a.point.y() < b.point.y();
  }

  Vec2 centre_;
  core::BoundedVector<Contact, 8> nearest_;
};

double surface_distance(const World::Segment& segment, const Vec2& point) {
  return distance(point, nearest_point(segment, point));
}

double surface_distance(const World::Circle& circle, const Vec2& point) {
  return distance(point, circle.centre) - circle.radius_m;
}

}  // namespace

/// The file and what is made of it for the queries. The boundary's long sides would widen the
/// tree's boxes, and its distance is quick to see: it stays outside.
struct World::Content {
  explicit Content(WorldFile world_file)
      : file(std::move(world_file)),
        mission(file.waypoints),
        boundary(file.boundary()),
        segments(solid_segments(file)),
        circles(file.circles),
        areas(file.polygons),
        corners(find_corners(segments, boundary, areas, circles)) {
    if (!file.has_mission) return;
    mission.push_back({file.target, file.target_radius_m, file.target_heading});
  }

  Circle disc_at(const MovingObstacle& obstacle, double time_s) const {
    return {obstacle.position_at(time_s), obstacle.radius_m};
  }

  WorldFile file;
  std::vector<Waypoint> mission;
  std::vector<Segment> boundary;
  Indexed<Segment> segments;
  Indexed<Circle> circles;
  FilledAreas areas;
  Indexed<Corner> corners;
};

core::Result<World> World::parse(std::string_view yaml, const std::string& file) {
  return parse(yaml, file, std::nullopt);
}

core::Result<World> World::parse(std::string_view yaml, const std::string& file,
                                 const std::optional<Goals>& goals) {
  auto world = read_world_file(yaml, file);
  if (!world.ok()) return world.error();
  if (goals) CLEW_RETURN_IF_ERROR(set_goals(*goals, *world));
  return World(std::make_unique<Content>(*std::move(world)));
}

World::World(std::unique_ptr<Content> content) : content_(std::move(content)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

const std::string& World::name() const { return content_->file.name; }
const std::string& World::about() const { return content_->file.about; }
const Vec2& World::bounds_min() const { return content_->file.bounds_min; }
const Vec2& World::bounds_max() const { return content_->file.bounds_max; }
const Pose2& World::start() const { return content_->file.start; }
const Vec2& World::target() const { return content_->file.target; }
double World::target_radius_m() const { return content_->file.target_radius_m; }
const std::optional<GoalHeading>& World::target_heading() const {
  return content_->file.target_heading;
}
const std::vector<Waypoint>& World::waypoints() const { return content_->mission; }
const std::vector<Vec2>& World::subgoals() const { return content_->file.subgoals; }
std::optional<bool> World::solvable() const { return content_->file.solvable; }
std::optional<double> World::shortest_path_m() const { return content_->file.shortest_path_m; }
const std::vector<World::Segment>& World::walls() const { return content_->file.walls; }
const std::vector<std::vector<Vec2>>& World::polygons() const { return content_->file.polygons; }
const std::vector<World::Circle>& World::circles() const { return content_->file.circles; }
const std::vector<MovingObstacle>& World::moving() const { return content_->file.moving; }

void World::place_moving(std::size_t index, const Vec2& place) {
  content_->file.moving.at(index).path.front().position = place;
}

core::Result<void> World::check_robot_fits(double radius_m) const {
  const WorldFile& file = content_->file;
  const NearestObstacle nearest =
      nearest_obstacle(file, file.start.position(), Obstacles::kAllAtTime0);
  if (nearest.clearance_m >= radius_m) return {};
  core::Error error = file.start_place;
  error.message =
      fmt::format("a robot of radius {} m does not fit at the start [{}, {}]: {} is {:.6g} m away",
                  radius_m, file.start.x_m, file.start.y_m, nearest.name, nearest.clearance_m);
  return error;
}

ConeDirection ConeDirection::of(double bearing_rad, double half_angle_rad) {
  return {core::direction(bearing_rad), core::direction(half_angle_rad)};
}

ConeDirection ConeDirection::turned(const Vec2& turn) const {
  return {{axis.x() * turn.x() - axis.y() * turn.y(), axis.y() * turn.x() + axis.x() * turn.y()},
          half_angle};
}

double World::cone_distance_m(const Vec2& apex, double bearing_rad, double half_angle_rad,
                              double max_distance_m, double time_s) const {
  return cone_distance_m(apex, ConeDirection::of(bearing_rad, half_angle_rad), max_distance_m,
                         time_s);
}

double World::cone_distance_m(const Vec2& apex, const ConeDirection& direction,
                              double max_distance_m, double time_s) const {
  const Content& content = *content_;
  if (content.areas.contains(apex)) return 0.0;
  const Cone cone(apex, direction);
  double nearest = max_distance_m * max_distance_m;
  const double farthest = nearest;
  const auto bound = [&](const Box& box) { return cone.bound(box, nearest); };
  const auto look = [&](const auto& shape) {
    nearest = std::min(nearest, cone.squared_distance(shape, nearest));
  };
  for (const MovingObstacle& obstacle : content.file.moving) {
    look(content.disc_at(obstacle, time_s));
  }
  content.circles.tree.visit_nearest_first(
      bound, nearest, [&](std::uint32_t i) { look(content.circles.shapes[i]); });
  content.segments.tree.visit_nearest_first(
      bound, nearest, [&](std::uint32_t i) { look(content.segments.shapes[i]); });
  for (const Segment& side : content.boundary) {
    if (squared_distance(apex, box_of(side)) < nearest) look(side);
  }
  return nearest < farthest ? std::sqrt(nearest) : max_distance_m;
}

void World::fan_distances_m(const Pose2& pose, const RayFan& fan, double max_distance_m,
                            double time_s, std::vector<double>& distances_m) const {
  const Content& content = *content_;
  if (content.areas.contains(pose.position())) {
    distances_m.assign(fan.size(), 0.0);
    return;
  }
  const double farthest = max_distance_m * max_distance_m;
  distances_m.assign(fan.size(), farthest);
  FanSweep sweep(fan, pose, distances_m.data());
  const auto bound = [&](const Box& box) { return squared_distance(sweep.apex(), box); };
  for (const MovingObstacle& obstacle : content.file.moving) {
    const Circle disc = content.disc_at(obstacle, time_s);
    if (bound(box_of(disc)) < farthest) sweep.look(disc);
  }
  content.circles.tree.visit_nearest_first(
      bound, farthest, [&](std::uint32_t i) { sweep.look(content.circles.shapes[i]); });
  content.segments.tree.visit_nearest_first(
      bound, farthest, [&](std::uint32_t i) { sweep.look(content.segments.shapes[i]); });
  for (const Segment& side : content.boundary) {
    if (bound(box_of(side)) < farthest) sweep.look(side);
  }
  for (double& distance : distances_m) {
    distance = distance < farthest ? std::sqrt(distance) : max_distance_m;
  }
}

std::optional<double> World::corner_distance_m(const Vec2& apex, double bearing_rad,
                                               double half_angle_rad, double max_distance_m) const {
  return nearest_corner_m(content_->corners,
                          Cone(apex, ConeDirection::of(bearing_rad, half_angle_rad)),
                          max_distance_m);
}

double World::clearance_m(const Vec2& point, double max_distance_m, double time_s) const {
  double nearest = max_distance_m;
  for (const MovingObstacle& obstacle : content_->file.moving) {
    nearest = std::min(nearest, surface_distance(content_->disc_at(obstacle, time_s), point));
  }
  return standing_clearance_m(point, std::max(nearest, 0.0));
}

double World::standing_clearance_m(const Vec2& point, double max_distance_m) const {
  const Content& content = *content_;
  if (content.areas.contains(point)) return 0.0;
  double nearest = max_distance_m;
  const auto bound = [&](const Box& box) { return std::sqrt(squared_distance(point, box)); };
  const auto look = [&](const auto& shape) {
    nearest = std::min(nearest, surface_distance(shape, point));
  };
  for (const Segment& side : content.boundary) look(side);
  content.circles.tree.visit_nearest_first(
      bound, nearest, [&](std::uint32_t i) { look(content.circles.shapes[i]); });
  content.segments.tree.visit_nearest_first(
      bound, nearest, [&](std::uint32_t i) { look(content.segments.shapes[i]); });
  return std::max(nearest, 0.0);
}

Sweep World::sweep_disc(const Vec2& from, const Vec2& to, double radius_m, double time_s,
                        double duration_s) const {
  const Content& content = *content_;
  const Motion motion{from, to - from};
  Sweep sweep;
  const auto touch = [&](const Segment& segment, double radius) {
    const double fraction = contact_fraction(motion, radius, segment);
    if (!(fraction < sweep.free_fraction)) return false;
    sweep.free_fraction = fraction;
    sweep.contact = true;
    return true;
  };
  const auto centre = [&] { return Vec2(from + sweep.free_fraction * motion.way); };
  const auto touch_segment = [&](const Segment& s) {
    if (touch(s, radius_m)) sweep.contact_point = nearest_point(s, centre());
  };
  for (const Segment& side : content.boundary) {
    if (contact_bound(motion, radius_m, box_of(side)) < 1.0) touch_segment(side);
  }
  content.segments.tree.visit_nearest_first(
      [&](const Box& box) { return contact_bound(motion, radius_m, box); }, sweep.free_fraction,
      [&](std::uint32_t i) { touch_segment(content.segments.shapes[i]); });
  content.circles.tree.visit_nearest_first(
      [&](const Box& box) { return contact_bound(motion, radius_m, box); }, sweep.free_fraction,
      [&](std::uint32_t i) {
        const Circle& circle = content.circles.shapes[i];
        const Segment point{circle.centre, circle.centre};
        if (touch(point, radius_m + circle.radius_m)) {
          sweep.contact_point = nearest_point(circle, centre());
        }
      });
  for (const MovingObstacle& obstacle : content.file.moving) {
    sweep_against(obstacle, motion, radius_m, time_s, duration_s, sweep);
  }
  return sweep;
}

core::BoundedVector<double, 8> World::contacts_rad(const Vec2& centre, double radius_m,
                                                   double tolerance_m, double time_s) const {
  const Content& content = *content_;
  const double reach = radius_m + tolerance_m;
  Contacts contacts(centre);
  const auto bound = [&](const Box& box) {
    return squared_distance(centre, box) <= reach * reach ? 0.0 : kFar;
  };
  const auto look = [&](const auto& shape) {
    const double distance_m = surface_distance(shape, centre);
    if (distance_m <= reach) contacts.add(nearest_point(shape, centre), distance_m);
  };
  for (const Segment& side : content.boundary) look(side);
  content.segments.tree.visit_nearest_first(
      bound, kFar, [&](std::uint32_t i) { look(content.segments.shapes[i]); });
  content.circles.tree.visit_nearest_first(
      bound, kFar, [&](std::uint32_t i) { look(content.circles.shapes[i]); });
  for (const MovingObstacle& obstacle : content.file.moving) {
    look(content.disc_at(obstacle, time_s));
  }
  return contacts.bearings_rad();
}

}  // namespace clew::world
