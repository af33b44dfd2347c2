// SPDX-License-Identifier: Apache-2.0
#include "gateway/foxglove_scene.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/math.hpp"
#include "gateway/json_text.hpp"
#include "runtime/run_plan.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using core::Pose2;
using core::Vec2;
using nlohmann::ordered_json;

constexpr std::size_t kPathTicks = 1000;
constexpr double kHeight_m = 0.3;

struct Colour {
  double r, g, b, a;
};
constexpr Colour kWall{0.55, 0.6, 0.65, 1.0};
constexpr Colour kSolid{0.45, 0.5, 0.55, 1.0};
constexpr Colour kRobot{0.0, 0.45, 0.7, 1.0};
constexpr Colour kTarget{0.0, 0.62, 0.45, 0.8};
constexpr Colour kMoving{0.84, 0.37, 0.0, 1.0};

ordered_json time_json(std::uint64_t ns) {
  return {{"sec", ns / 1000000000}, {"nsec", ns % 1000000000}};
}
ordered_json vector_json(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }
ordered_json point_json(const Vec2& place) { return vector_json(place.x(), place.y(), 0.0); }
ordered_json colour_json(const Colour& c) {
  return {{"r", c.r}, {"g", c.g}, {"b", c.b}, {"a", c.a}};
}
ordered_json turn_json(double heading_rad) {
  const Vec2 half = core::direction(heading_rad / 2.0);
  return {{"x", 0.0}, {"y", 0.0}, {"z", half.y()}, {"w", half.x()}};
}
ordered_json pose_json(const Vec2& place, double z, double heading_rad) {
  return {{"position", vector_json(place.x(), place.y(), z)},
          {"orientation", turn_json(heading_rad)}};
}
ordered_json pose_json(const Pose2& pose) {
  return pose_json(pose.position(), 0.0, pose.heading_rad);
}

/// Line strips are 0, loops 1, pairs of points 2.
ordered_json line_json(int kind, const ordered_json& points, const Colour& colour) {
  return {{"type", kind},
          {"pose", pose_json(Vec2::Zero(), 0.0, 0.0)},
          {"thickness", 0.04},
          {"scale_invariant", false},
          {"points", points},
          {"color", colour_json(colour)},
          {"colors", ordered_json::array()},
          {"indices", ordered_json::array()}};
}

ordered_json cylinder_json(const Vec2& centre, double radius_m, const Colour& colour) {
  return {{"pose", pose_json(centre, kHeight_m / 2.0, 0.0)},
          {"size", vector_json(2.0 * radius_m, 2.0 * radius_m, kHeight_m)},
          {"bottom_scale", 1.0},
          {"top_scale", 1.0},
          {"color", colour_json(colour)}};
}

ordered_json entity_json(const char* id, std::uint64_t time_ns) {
  ordered_json entity = {{"timestamp", time_json(time_ns)},
                         {"frame_id", "world"},
                         {"id", id},
                         {"lifetime", time_json(0)},
                         {"frame_locked", false}};
  for (const char* list : {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines",
                           "triangles", "texts", "models"}) {
    entity[list] = ordered_json::array();
  }
  return entity;
}

ordered_json loop_json(const std::vector<Vec2>& corners, const Colour& colour) {
  ordered_json points = ordered_json::array();
  for (const Vec2& corner : corners) points.push_back(point_json(corner));
  return line_json(1, points, colour);
}

ordered_json world_json(const world::World& world, std::uint64_t time_ns) {
  ordered_json entity = entity_json("world", time_ns);
  const Vec2 low = world.bounds_min();
  const Vec2 high = world.bounds_max();
  entity["lines"].push_back(
      loop_json({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, kWall));
  ordered_json ends = ordered_json::array();
  for (const auto& wall : world.walls()) {
    ends.push_back(point_json(wall.a));
    ends.push_back(point_json(wall.b));
  }
  if (!ends.empty()) entity["lines"].push_back(line_json(2, ends, kWall));
  for (const auto& polygon : world.polygons())
    entity["lines"].push_back(loop_json(polygon, kSolid));
  for (const auto& circle : world.circles()) {
    entity["cylinders"].push_back(cylinder_json(circle.centre, circle.radius_m, kSolid));
  }
  return entity;
}

ordered_json text_json(const Vec2& place, const std::string& text, const Colour& colour) {
  return {{"pose", pose_json(place, kHeight_m, 0.0)},
          {"billboard", true},
          {"font_size", 0.3},
          {"scale_invariant", false},
          {"color", colour_json(colour)},
          {"text", text}};
}

/// The heading that a robot is to have at a place.
ordered_json arrow_json(const world::Waypoint& waypoint) {
  constexpr double kLength_m = 0.5;
  return {{"pose", pose_json(waypoint.place, kHeight_m, waypoint.heading->heading_rad)},
          {"shaft_length", 0.7 * kLength_m},
          {"shaft_diameter", 0.05},
          {"head_length", 0.3 * kLength_m},
          {"head_diameter", 0.12},
          {"color", colour_json(kTarget)}};
}

/// Way-points with their radius and heading; several are joined in their order, and have their
/// numbers.
void add_mission(const GivenMission& mission, ordered_json& entity) {
  ordered_json way = ordered_json::array();
  for (const world::Waypoint& waypoint : mission.waypoints) {
    entity["cylinders"].push_back(
        cylinder_json(waypoint.place, std::max(waypoint.radius_m, 0.05), kTarget));
    if (waypoint.heading) entity["arrows"].push_back(arrow_json(waypoint));
    way.push_back(point_json(waypoint.place));
    if (mission.waypoints.size() == 1) return;
    entity["texts"].push_back(text_json(waypoint.place, std::to_string(way.size()), kWall));
  }
  if (!way.empty()) entity["lines"].push_back(line_json(0, way, kTarget));
}

/// What of it can be read of the samples of one tick.
bool take(const std::vector<SampleView>& samples, domain::Messages& messages) {
  bool has_state = false;
  for (const SampleView& sample : samples) {
    domain::visit_topic(sample.topic, [&](auto constant) {
      auto& message = std::get<constant.kIndex>(messages);
      const auto decoded = decode(sample.cdr, &message, Values::kAny);
      if (decoded.ok() && sample.topic == domain::Topic::kState) has_state = true;
    });
  }
  return has_state;
}

template <typename Message>
const Message& of(const domain::Messages& messages) {
  return std::get<static_cast<std::size_t>(domain::topic_of<Message>())>(messages);
}

bool has(const std::vector<SampleView>& samples, domain::Topic topic) {
  return std::any_of(samples.begin(), samples.end(),
                     [&](const SampleView& sample) { return sample.topic == topic; });
}

}  // namespace

core::Result<FoxgloveScene> FoxgloveScene::create(const RunDescription& description) {
  const auto world = description.bundle.find("world.yaml");
  const auto robot = description.bundle.find("robot.yaml");
  if (world == description.bundle.end() || robot == description.bundle.end()) {
    return core::Error{"does not hold the run's world.yaml and robot.yaml"};
  }
  auto read = world::World::parse(world->second, "world.yaml");
  if (!read.ok()) return read.error();
  const auto body = runtime::read_robot({"robot.yaml", robot->second}, "robot");
  if (!body.ok()) return body.error();
  auto missions = missions_of(description.bundle, {});
  if (!missions.ok()) return missions.error();
  FoxgloveScene scene(std::move(read).value(), body->radius_m, description.bundle);
  scene.missions_ = std::move(missions).value();
  return scene;
}

// The run took them, so they can be read: nothing is refused here.
void FoxgloveScene::take_changes(const std::vector<domain::Intervention>& interventions) {
  if (interventions.size() == interventions_) return;
  interventions_ = interventions.size();
  if (auto missions = missions_of(bundle_, interventions); missions.ok()) {
    missions_ = std::move(missions).value();
  }
}

const GivenMission& FoxgloveScene::mission_at(std::uint64_t tick) const {
  const auto later = std::find_if(std::next(missions_.begin()), missions_.end(),
                                  [&](const GivenMission& mission) { return mission.tick > tick; });
  return *std::prev(later);
}

std::vector<FoxgloveMessage> FoxgloveScene::convert(std::uint64_t time_ns,
                                                    const std::vector<SampleView>& samples) {
  std::vector<FoxgloveMessage> messages;
  if (!take(samples, now_)) return messages;
  messages.push_back(transforms(time_ns));
  messages.push_back(scene(time_ns));
  messages.push_back(path(time_ns));
  if (has(samples, domain::Topic::kScan)) messages.push_back(scan(time_ns));
  if (has(samples, domain::Topic::kEvent)) log(time_ns, messages);
  see(time_ns, has(samples, domain::Topic::kScan) && has(samples, domain::Topic::kOdometry),
      messages);
  return messages;
}

FoxgloveMessage FoxgloveScene::scene(std::uint64_t time_ns) {
  const auto& state = of<domain::State>(now_);
  ordered_json entities = ordered_json::array();
  if (!std::exchange(has_world_, true)) entities.push_back(world_json(world_, time_ns));
  ordered_json movers = entity_json("run", time_ns);
  add_mission(mission_at(state.stamp.tick), movers);
  const Pose2& robot = state.pose_world_robot;
  movers["cylinders"].push_back(cylinder_json(robot.position(), radius_m_, kRobot));
  for (const auto& obstacle : world_.moving()) {
    movers["cylinders"].push_back(
        cylinder_json(obstacle.position_at(state.stamp.sim_time_s), obstacle.radius_m, kMoving));
  }
  entities.push_back(std::move(movers));
  return {FoxgloveTopic::kScene,
          json_text({{"deletions", ordered_json::array()}, {"entities", std::move(entities)}})};
}

// Our ranges begin at the robot's skin, theirs at its centre.
FoxgloveMessage FoxgloveScene::scan(std::uint64_t time_ns) const {
  const auto& scan = of<domain::Scan>(now_);
  ordered_json ranges = ordered_json::array();
  for (const double range_m : scan.ranges_m) ranges.push_back(range_m + radius_m_);
  const std::size_t last = scan.ranges_m.empty() ? 0 : scan.ranges_m.size() - 1;
  return {FoxgloveTopic::kScan, json_text({{"timestamp", time_json(time_ns)},
                                           {"frame_id", "robot"},
                                           {"pose", pose_json(Vec2::Zero(), 0.0, 0.0)},
                                           {"start_angle", scan.bearing_first_rad},
                                           {"end_angle", scan.bearing_rad(last)},
                                           {"ranges", ranges},
                                           {"intensities", ordered_json::array()}})};
}

FoxgloveMessage FoxgloveScene::transforms(std::uint64_t time_ns) const {
  const Pose2& truth = of<domain::State>(now_).pose_world_robot;
  const Pose2& belief = of<domain::Odometry>(now_).pose_odom_robot;
  const auto transform = [&](const char* parent, const char* child, const Pose2& pose) {
    return ordered_json{{"timestamp", time_json(time_ns)},
                        {"parent_frame_id", parent},
                        {"child_frame_id", child},
                        {"translation", point_json(pose.position())},
                        {"rotation", turn_json(pose.heading_rad)}};
  };
  // Where the odometry's frame lies in the world: the true pose, and back by the believed one.
  const double turn_rad = truth.heading_rad - belief.heading_rad;
  const Vec2 turn = core::direction(turn_rad);
  const Vec2 back(turn.x() * belief.x_m - turn.y() * belief.y_m,
                  turn.y() * belief.x_m + turn.x() * belief.y_m);
  const Vec2 origin = truth.position() - back;
  const Pose2 odom{origin.x(), origin.y(), turn_rad};
  return {FoxgloveTopic::kTransforms,
          json_text({{"transforms", ordered_json::array({transform("world", "odom", odom),
                                                         transform("odom", "robot", belief)})}})};
}

FoxgloveMessage FoxgloveScene::path(std::uint64_t time_ns) {
  path_.push_back(of<domain::State>(now_).pose_world_robot);
  if (path_.size() > kPathTicks) path_.pop_front();
  ordered_json poses = ordered_json::array();
  for (const Pose2& pose : path_) poses.push_back(pose_json(pose));
  return {FoxgloveTopic::kPath,
          json_text({{"timestamp", time_json(time_ns)}, {"frame_id", "world"}, {"poses", poses}})};
}

void FoxgloveScene::see(std::uint64_t time_ns, bool has_scan,
                        std::vector<FoxgloveMessage>& messages) {
  if (has_scan) seen_.see(of<domain::Odometry>(now_), of<domain::Scan>(now_));
  const bool at_end = of<domain::State>(now_).outcome != domain::Outcome::kRunning;
  if (auto grid = seen_.message(time_ns, at_end)) {
    messages.push_back({FoxgloveTopic::kSeen, std::move(*grid)});
  }
}

void FoxgloveScene::log(std::uint64_t time_ns, std::vector<FoxgloveMessage>& messages) const {
  constexpr int kInformation = 2;
  constexpr int kWarning = 3;
  const char* const words[] = {"landmark",     "reflex",        "trap",           "escape begun",
                               "escape ended", "escape failed", "virtual target", "unreachable"};
  for (const auto& entry : of<domain::Event>(now_).entries) {
    const auto kind = static_cast<std::size_t>(entry.kind);
    std::string text = kind < std::size(words) ? words[kind] : "unknown event";
    if (entry.shadow) text += " (in shadow)";
    if (!entry.text.empty()) text += ": " + entry.text;
    const bool warns = entry.kind == domain::EventKind::kTrap ||
                       entry.kind == domain::EventKind::kEscapeFailed ||
                       entry.kind == domain::EventKind::kUnreachable;
    messages.push_back({FoxgloveTopic::kLog, json_text({{"timestamp", time_json(time_ns)},
                                                        {"level", warns ? kWarning : kInformation},
                                                        {"message", text},
                                                        {"name", entry.rule},
                                                        {"file", ""},
                                                        {"line", 0}})});
  }
}

}  // namespace clew::bridge
