// SPDX-License-Identifier: Apache-2.0
#include "control/polar/polar_neural_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "scan/scan_needs.hpp"

namespace clew::control {
namespace {

constexpr double kAtRest_radps = 1e-6;

/// What tells what is ahead of and beside the robot.
scan::ScanNeeds polar_needs() {
  scan::ScanNeeds needs;
  needs.least_beams = 2;
  needs.most_apart_rad = core::radians(30.0);
  needs.least_seen_rad = core::radians(90.0);
  return needs;
}

/// A place of the world in the frame of a pose.
core::Vec2 seen_from(const core::Pose2& pose, const core::Vec2& place) {
  const core::Vec2 ahead = core::direction(pose.heading_rad);
  const core::Vec2 offset = place - pose.position();
  return {ahead.x() * offset.x() + ahead.y() * offset.y(),
          ahead.x() * offset.y() - ahead.y() * offset.x()};
}

/// The reverse.
core::Vec2 placed_from(const core::Pose2& pose, const core::Vec2& seen) {
  const core::Vec2 ahead = core::direction(pose.heading_rad);
  return pose.position() + core::Vec2(ahead.x() * seen.x() - ahead.y() * seen.y(),
                                      ahead.y() * seen.x() + ahead.x() * seen.y());
}

/// How many scans the memory holds, the present one included.
std::size_t scans_of(const PolarNeuralMapParameters& p, double tick_s) {
  return static_cast<std::size_t>(std::max(1L, std::lround(p.memory_s / tick_s)));
}

PolarLattice lattice_of(const PolarNeuralMapParameters& p) {
  return {static_cast<std::size_t>(p.rings), static_cast<std::size_t>(p.sectors), p.scope_m};
}

}  // namespace

core::Result<std::unique_ptr<PolarNeuralMap>> PolarNeuralMap::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  CLEW_RETURN_IF_ERROR(scan::check_needs(polar_needs(), setup.scan, "polar_neural_map"));
  return std::make_unique<PolarNeuralMap>(parameters, setup);
}

PolarNeuralMap::PolarNeuralMap(const Parameters& parameters, const domain::BehaviourSetup& setup)
    : parameters_(parameters),
      radius_m_(setup.robot.radius_m),
      prediction_(setup.tick_s),
      memory_(scans_of(parameters, setup.tick_s), setup.scan.beam_count, setup.robot.radius_m),
      landscape_(lattice_of(parameters), parameters.gain_ratio),
      window_(parameters.window, setup.limits, setup.robot.radius_m) {
  returns_.reserve(setup.scan.beam_count * scans_of(parameters, setup.tick_s));
  seen_.reserve(setup.scan.beam_count * 3);
}

domain::Motion PolarNeuralMap::step(const domain::Odometry& odometry, const domain::Scan& scan,
                                    const core::Vec2& target_odom) {
  const core::Pose2& pose = odometry.pose_odom_robot;
  if (!prediction_.observe(odometry.stamp.sim_time_s)) memory_.forget();
  memory_.add(pose, scan);
  pose_odom_robot_ = pose;
  pose_odom_map_ = map_pose(odometry, target_odom);
  const core::Vec2 target_map = seen_from(pose_odom_map_, target_odom);
  draw_map(target_map);
  DynamicWindow::Goal goal = turn_on_the_spot(odometry, target_odom);
  subgoal_odom_ = pose.position();
  if (const auto subgoal = landscape_.subgoal()) {
    const DynamicWindow::Goal on_map = goal_on_map(*subgoal, target_map);
    subgoal_odom_ = placed_from(pose_odom_map_, on_map.place);
    goal.place = seen_from(pose, subgoal_odom_);
    goal.heading_rad =
        core::wrap_angle_rad(on_map.heading_rad + pose_odom_map_.heading_rad - pose.heading_rad);
  }
  look_around(pose, prediction_.cycle_s(), scan);
  const WindowCell& chosen = window_.choose(odometry.speed_mps, odometry.turn_rate_radps,
                                            prediction_.cycle_s(), goal, seen_, returns_);
  domain::Motion motion;
  motion.kind = domain::CommandKind::kVelocities;
  motion.speed_mps = chosen.speed_mps;
  motion.turn_rate_radps = chosen.turn_rate_radps;
  return motion;
}

/// Where the robot will be at the end of the cycle, looking toward the target.
core::Pose2 PolarNeuralMap::map_pose(const domain::Odometry& odometry,
                                     const core::Vec2& target_odom) const {
  core::Pose2 pose = odometry.pose_odom_robot;
  if (parameters_.predict) {
    pose = prediction_.predict(pose, odometry.speed_mps, odometry.turn_rate_radps);
  }
  pose.heading_rad = core::wrap_angle_rad(pose.heading_rad + core::bearing_rad(pose, target_odom));
  return pose;
}

/// With less and less room where activation does not reach the robot, and at last with nothing but
/// the present scan.
void PolarNeuralMap::draw_map(const core::Vec2& target_map) {
  memory_.returns_seen_from(pose_odom_map_, parameters_.scope_m, returns_);
  for (const double share : {1.0, 0.5, 0.0}) {
    if (spread_activation(radius_m_ + share * parameters_.clearance_m, target_map)) return;
  }
  memory_.newest_seen_from(pose_odom_map_, parameters_.scope_m, returns_);
  spread_activation(radius_m_, target_map);
}

/// Whether it reaches the robot.
bool PolarNeuralMap::spread_activation(double reach_m, const core::Vec2& target_map) {
  landscape_.clear();
  for (const core::Vec2& place : returns_) landscape_.obstruct(place, reach_m);
  landscape_.set_target(target_map);
  landscape_.settle(static_cast<int>(parameters_.most_patterns));
  return landscape_.subgoal().has_value();
}

/// The subgoal as a configuration in the map's frame.
DynamicWindow::Goal PolarNeuralMap::goal_on_map(const PolarUnit& subgoal,
                                                const core::Vec2& target_map) const {
  if (subgoal == landscape_.target()) {
    const double distance_m = core::length(target_map);
    const double share = distance_m > parameters_.scope_m ? parameters_.scope_m / distance_m : 1.0;
    return {share * target_map, core::atan2(target_map.y(), target_map.x())};
  }
  const PolarLattice& lattice = landscape_.lattice();
  return {lattice.place(subgoal), lattice.bearing_rad(subgoal.sector)};
}

DynamicWindow::Goal PolarNeuralMap::turn_on_the_spot(const domain::Odometry& odometry,
                                                     const core::Vec2& target_odom) const {
  const double side = std::fabs(odometry.turn_rate_radps) > kAtRest_radps
                          ? odometry.turn_rate_radps
                          : core::bearing_rad(odometry.pose_odom_robot, target_odom);
  return {core::Vec2::Zero(), side < 0.0 ? -0.5 * core::kPi : 0.5 * core::kPi};
}

/// What the window heeds: the beams of the present scan, and the returns of all.
void PolarNeuralMap::look_around(const core::Pose2& pose, double cycle_s,
                                 const domain::Scan& scan) {
  const double reach_m = window_.reach_m(cycle_s);
  memory_.returns_seen_from(pose, reach_m, returns_);
  memory_.newest_seen_from(pose, reach_m, seen_);
  if (scan.beam_width_rad == 0.0) return;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double distance_m = radius_m_ + scan.ranges_m[i];
    if (scan.ranges_m[i] >= scan.range_max_m || distance_m > reach_m) continue;
    for (const double end : {-0.5, 0.5}) {
      seen_.push_back(distance_m *
                      core::direction(scan.bearing_rad(i) + end * scan.beam_width_rad));
    }
  }
}

void PolarNeuralMap::save(core::StateWriter& writer) const {
  writer(prediction_.state(), memory_.state());
}

void PolarNeuralMap::load(core::StateReader& reader) {
  const std::size_t scans = memory_.state().scans.size();
  reader(prediction_.state(), memory_.state());
  const ScanMemory::State& memory = memory_.state();
  reader.check(memory.scans.size() == scans && memory.newest < scans, "there is no such scan");
  bool short_enough = true;
  for (const ScanMemory::Kept& kept : memory.scans) {
    short_enough = short_enough && kept.returns_robot.size() <= domain::kMaxRanges;
  }
  reader.check(short_enough, "a scan has more returns than beams");
  if (reader.ok()) return;
  memory_.state() = {};
  memory_.state().scans.resize(scans);
}

}  // namespace clew::control
