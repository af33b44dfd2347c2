// SPDX-License-Identifier: Apache-2.0
#include "ros2/run_publisher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/angle.hpp"
#include "core/math.hpp"
#include "ros2/robot_inputs.hpp"

namespace clew::ros2 {
namespace {

/// Cells of /map; coarser where the world is larger than the most cells.
constexpr double kMapCell_m = 0.05;
constexpr std::size_t kMostMapCells = 4'000'000;
/// A run that has been silent for so long is said to be stale.
constexpr double kStaleAfter_s = 2.0;

const char* outcome_word(domain::Outcome outcome) {
  switch (outcome) {
    case domain::Outcome::kRunning:
      return "running";
    case domain::Outcome::kReached:
      return "reached";
    case domain::Outcome::kCollided:
      return "collided";
    case domain::Outcome::kUnreachable:
      return "unreachable";
    case domain::Outcome::kTimeout:
      return "timeout";
  }
  return "unknown";
}

/// The cells that a map of what was seen has, as a grid that holds them all.
OccupancyGrid to_grid(const map::SeenMap& seen, const std::string& frame, const Time& stamp) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const core::Vec2 least(-kInfinite, -kInfinite);
  const core::Vec2 most(kInfinite, kInfinite);
  core::Vec2 corner(kInfinite, kInfinite);
  core::Vec2 far(-kInfinite, -kInfinite);
  for (const auto& [key, tile] : seen.state().tiles) {
    const core::Vec2 place(key.first * seen.tile_m(), key.second * seen.tile_m());
    corner = corner.cwiseMin(place);
    far = far.cwiseMax(place + core::Vec2(seen.tile_m(), seen.tile_m()));
  }
  OccupancyGrid grid;
  grid.header = {stamp, frame};
  grid.info.resolution = static_cast<float>(seen.cell_m());
  if (seen.state().tiles.empty()) return grid;
  grid.info.width = static_cast<std::uint32_t>(std::lround((far - corner).x() / seen.cell_m()));
  grid.info.height = static_cast<std::uint32_t>(std::lround((far - corner).y() / seen.cell_m()));
  grid.info.origin = to_pose({corner.x(), corner.y(), 0.0});
  grid.data.assign(static_cast<std::size_t>(grid.info.width) * grid.info.height, -1);
  const auto mark = [&](map::Mark kind, std::int8_t value) {
    seen.for_each(kind, least, most, [&](const core::Vec2& place) {
      const auto column = static_cast<std::size_t>((place - corner).x() / seen.cell_m());
      const auto row = static_cast<std::size_t>((place - corner).y() / seen.cell_m());
      grid.data[row * grid.info.width + column] = value;
    });
  };
  mark(map::Mark::kFree, 0);
  mark(map::Mark::kSuspected, 50);
  mark(map::Mark::kHit, 100);
  return grid;
}

map::LocalMapParameters seen_parameters() {
  map::LocalMapParameters parameters;
  parameters.cell_m = kMapCell_m;
  return parameters;
}

}  // namespace

RunPublisher::RunPublisher(const Names& names, const runtime::RunPlan& plan, std::string node_name)
    : plan_(plan),
      frames_(Frames::of(names)),
      node_name_(std::move(node_name)),
      seen_(seen_parameters(), plan.setup.behaviour.robot.radius_m),
      markers_(frames_) {}

core::Result<std::unique_ptr<RunPublisher>> RunPublisher::create(TopicOutput& output,
                                                                 const Names& names,
                                                                 const std::string& node_name,
                                                                 const runtime::RunPlan& plan) {
  std::unique_ptr<RunPublisher> self(new RunPublisher(names, plan, node_name));
  CLEW_RETURN_IF_ERROR(self->open(output, names));
  return self;
}

core::Result<void> RunPublisher::open(TopicOutput& output, const Names& names) {
  core::Result<void> result;
  const auto create = [&](auto& publisher, const char* topic, const QosProfile& profile) {
    using Message = typename std::decay_t<decltype(*publisher)>::Type;
    if (!result.ok()) return;
    auto created = Publisher<Message>::create(output, names.topic(topic), profile);
    if (created.ok()) {
      publisher.emplace(std::move(created).value());
    } else {
      result = created.error();
    }
  };
  create(clock_, "/clock", kClockProfile);
  create(scan_, "scan", kScanProfile);
  create(odometry_, "odom", kDefaultProfile);
  create(tf_, "/tf", kTfProfile);
  create(tf_static_, "/tf_static", kLatchedProfile);
  create(map_, "map", kLatchedProfile);
  create(map_seen_, "map_seen", kLatchedProfile);
  create(path_, "plan", kDefaultProfile);
  create(goal_, "goal_pose", kLatchedProfile);
  create(diagnostics_, "/diagnostics", kDefaultProfile);
  create(log_, "/rosout", kLogProfile);
  create(marker_array_, "markers", kLatchedProfile);
  return result;
}

void RunPublisher::begin() {
  tf_static_->publish({{to_transform({}, frames_.base, frames_.laser, {})}});
  if (plan_.setup.world != nullptr) {
    map_->publish(ros2::to_grid(*plan_.setup.world, frames_, kMapCell_m, kMostMapCells));
  }
  say(Log::kInfo, "graph " + plan_.graph.name + ", world " + plan_.graph.world);
}

void RunPublisher::add(const bridge::Sample& sample) {
  domain::visit_topic(sample.topic, [&](auto topic) {
    auto& message = std::get<decltype(topic)::kIndex>(messages_);
    typename decltype(topic)::Message next;
    if (!std::get<decltype(topic)::kIndex>(codecs_).decode(sample.cdr, next).ok()) {
      ++refused_;
      return;
    }
    // A component that was restarted writes again what it wrote before.
    std::uint64_t& next_sequence = next_sequence_[index_of(sample.topic)];
    if (next.stamp.sequence < next_sequence) return;
    next_sequence = next.stamp.sequence + 1;
    message = std::move(next);
    take(message);
  });
}

void RunPublisher::take(const domain::State& state) {
  clock_->publish({to_time(state.stamp.sim_time_s)});
  ticks_ = state.stamp.tick;
  if (state.command_late) ++late_commands_;
  publish_transforms();
  if (state.outcome != domain::Outcome::kRunning && outcome_ != state.outcome) {
    outcome_ = state.outcome;
    const bool good = state.outcome == domain::Outcome::kReached;
    say(good ? Log::kInfo : Log::kWarn, std::string("outcome: ") + outcome_word(state.outcome));
  }
}

void RunPublisher::take(const domain::Odometry& odometry) {
  odometry_->publish(to_odometry(odometry, frames_));
  publish_transforms();
}

/// Once a tick, when both poses of it are there.
void RunPublisher::publish_transforms() {
  const auto& state = std::get<domain::State>(messages_);
  const auto& odometry = std::get<domain::Odometry>(messages_);
  if (!has(domain::Topic::kState) || !has(domain::Topic::kOdometry)) return;
  if (state.stamp.tick != odometry.stamp.tick || transforms_tick_ == state.stamp.tick) return;
  transforms_tick_ = state.stamp.tick;
  const Time stamp = to_time(state.stamp.sim_time_s);
  tf_->publish({{to_transform(stamp, frames_.map, frames_.odom,
                              odom_in_map(state.pose_world_robot, odometry.pose_odom_robot)),
                 to_transform(stamp, frames_.odom, frames_.base, odometry.pose_odom_robot)}});
}

void RunPublisher::take(const domain::Scan& scan) {
  const domain::BehaviourSetup& setup = plan_.setup.behaviour;
  scan_->publish(to_laser_scan(scan, frames_, setup.robot.radius_m, setup.tick_s));
  const auto& odometry = std::get<domain::Odometry>(messages_);
  if (!has(domain::Topic::kOdometry) || odometry.stamp.tick != scan.stamp.tick) return;
  seen_.see(odometry, scan);
  seen_changed_ = true;
}

void RunPublisher::take(const domain::Target& target) {
  if (goal_sent_ && *goal_sent_ == target.position()) return;
  goal_sent_ = target.position();
  goal_->publish(to_goal(target, frames_));
}

void RunPublisher::take(const domain::Guidance& guidance) {
  if (!has(domain::Topic::kOdometry) || !has(domain::Topic::kTarget)) return;
  const auto& odometry = std::get<domain::Odometry>(messages_);
  const auto& target = std::get<domain::Target>(messages_);
  path_->publish(to_path(odometry, guidance, target, frames_));
}

void RunPublisher::take(const domain::Event& event) {
  for (const domain::EventEntry& entry : event.entries) {
    markers_.add(event.stamp, entry);
    log_->publish(to_log(event.stamp, entry, node_name_));
  }
}

void RunPublisher::say(std::uint8_t level, const std::string& name, const std::string& text) {
  Log log;
  log.stamp = to_time(std::get<domain::State>(messages_).stamp.sim_time_s);
  log.level = level;
  log.name = name;
  log.msg = text;
  log_->publish(log);
}

void RunPublisher::log(logs::Level level, const std::string& speaker, const std::string& text) {
  const std::uint8_t ros = level == logs::Level::kError     ? Log::kError
                           : level == logs::Level::kWarning ? Log::kWarn
                                                            : Log::kInfo;
  say(ros, node_name_ + '.' + speaker, text);
}

void RunPublisher::publish_seen() {
  const Time stamp = to_time(std::get<domain::Odometry>(messages_).stamp.sim_time_s);
  OccupancyGrid grid = to_grid(seen_.seen(), frames_.odom, stamp);
  if (grid.data.size() <= kMostMapCells) map_seen_->publish(grid);
  seen_changed_ = false;
}

DiagnosticArray RunPublisher::diagnostics(double idle_s, std::uint64_t dropped) const {
  const auto& state = std::get<domain::State>(messages_);
  DiagnosticArray array;
  array.header.stamp = to_time(state.stamp.sim_time_s);
  DiagnosticStatus& status = array.status.emplace_back();
  status.name = node_name_ + ": run";
  status.hardware_id = plan_.graph.robot;
  status.message = outcome_word(state.outcome);
  if (late_commands_ > 0 || dropped > 0 || refused_ > 0) status.level = DiagnosticStatus::kWarn;
  if (state.outcome == domain::Outcome::kCollided) status.level = DiagnosticStatus::kError;
  if (!outcome_ && idle_s > kStaleAfter_s) {
    status.level = DiagnosticStatus::kStale;
    status.message = fmt::format("silent for {:.0f} s", idle_s);
  }
  status.values = {{"ticks", std::to_string(ticks_)},
                   {"sim_time_s", fmt::format("{}", state.stamp.sim_time_s)},
                   {"collisions", std::to_string(state.collisions)},
                   {"safety_stops", std::to_string(state.safety_stops)},
                   {"late_commands", std::to_string(late_commands_)},
                   {"refused_samples", std::to_string(refused_)},
                   {"dropped_samples", std::to_string(dropped)}};
  return array;
}

void RunPublisher::add_report(double idle_s, std::uint64_t dropped) {
  diagnostics_->publish(diagnostics(idle_s, dropped));
  if (markers_.changed()) marker_array_->publish(markers_.all());
  if (seen_changed_) publish_seen();
}

core::Result<core::Pose2> RunPublisher::pose_in_world(const PoseStamped& place) const {
  const core::Vec2 at(place.pose.position.x, place.pose.position.y);
  if (!std::isfinite(at.x()) || !std::isfinite(at.y())) {
    return core::Error{"a place that is none"};
  }
  const auto pose = to_pose2(place.pose);
  const double heading_rad = pose.ok() ? pose->heading_rad : 0.0;
  const std::string& frame = place.header.frame_id;
  if (frame == frames_.map) return core::Pose2{at.x(), at.y(), heading_rad};
  if (frame != frames_.odom || !has(domain::Topic::kState) || !has(domain::Topic::kOdometry)) {
    return core::Error{
        fmt::format("frame '{}'; allowed: {}, {}", frame, frames_.map, frames_.odom)};
  }
  const core::Pose2 odom = odom_in_map(std::get<domain::State>(messages_).pose_world_robot,
                                       std::get<domain::Odometry>(messages_).pose_odom_robot);
  const double c = core::cos(odom.heading_rad);
  const double s = core::sin(odom.heading_rad);
  return core::Pose2{odom.x_m + c * at.x() - s * at.y(), odom.y_m + s * at.x() + c * at.y(),
                     core::wrap_angle_rad(odom.heading_rad + heading_rad)};
}

void RunPublisher::end(const std::string& why) {
  add_report(0.0, 0);
  say(Log::kInfo, why);
}

}  // namespace clew::ros2
