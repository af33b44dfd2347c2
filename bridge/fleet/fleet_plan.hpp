// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "fleet/fleet_file.hpp"
#include "fleet/robot_world.hpp"
#include "runtime/run_plan.hpp"
#include "world/world.hpp"

namespace clew::fleet {

/// What the command line changes in a fleet file.
struct FleetOverrides {
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> max_ticks;
};

/// Places of robots that are kept, one a robot and tick.
inline constexpr std::uint64_t kMostPlaces = 5'000'000;
/// The same of a fleet that is recorded: each recording has the ways of all others in its world.
inline constexpr std::uint64_t kMostRecordedPlaces = 500'000;
/// The latest time of a world file, which the others' ways are part of.
inline constexpr double kLongest_s = 1e5;

/// A robot that is ready to run.
struct RobotPlan {
  RobotEntry entry;
  runtime::RunPlan plan;
  /// That of the plan: where the others stand in it changes from tick to tick.
  std::shared_ptr<world::World> world;
  double seen_radius_m = 0.0;  ///< of the disc that it is in the others' worlds
};

/// A fleet that is ready to run.
class FleetPlan {
 public:
  /// Reads everything that the file names, and makes every component once. Refused, with the place
  /// and what is allowed: what runtime::prepare_run refuses, robots that stand in obstacles or in
  /// each other's discs, targets where none may lie, ticks of different length, components of
  /// someone else's or on other hosts, drives without the safety layer or a greatest speed, more
  /// than kMostPlaces, and more than kLongest_s.
  static core::Result<FleetPlan> prepare(FleetFile file, const FleetOverrides& overrides,
                                         const runtime::ConfigSource& source,
                                         const std::vector<runtime::StageInfo>& stages);

  const FleetFile& file() const { return file_; }
  const std::vector<RobotPlan>& robots() const { return robots_; }
  double tick_s() const { return robots_.front().plan.graph.tick_s; }
  /// Refuses more than `most` places of all robots together.
  core::Result<void> check_ticks(std::uint64_t most) const;
  /// How many obstacles moving() of each robot's world has before the others.
  std::size_t moving_before_others() const { return world_->moving().size(); }

  /// The plan of one robot by itself, to which the others, in their order, moved so. It does what
  /// the robot did in the fleet.
  core::Result<runtime::RunPlan> alone(std::size_t robot,
                                       const std::vector<OtherRobot>& others) const;

 private:
  FleetPlan(FleetFile file, const FleetOverrides& overrides, const runtime::ConfigSource& source,
            const std::vector<runtime::StageInfo>& stages)
      : file_(std::move(file)), overrides_(overrides), source_(source), stages_(stages) {}

  core::Result<void> read_world();
  core::Result<void> read_robots();
  core::Result<void> check_robot(const RobotPlan& robot) const;
  core::Result<void> check_places() const;
  core::Result<void> place_robots();
  core::Result<runtime::RunPlan> plan_of(std::size_t index, const RobotEntry& entry,
                                         const std::vector<OtherRobot>& others) const;

  FleetFile file_;
  FleetOverrides overrides_;
  const runtime::ConfigSource& source_;
  const std::vector<runtime::StageInfo>& stages_;
  std::shared_ptr<const world::World> world_;
  std::vector<RobotPlan> robots_;
};

}  // namespace clew::fleet
