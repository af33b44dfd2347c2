// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "core/result.hpp"
#include "domain/messages.hpp"
#include "domain/topics.hpp"
#include "gateway/foxglove_grid.hpp"
#include "gateway/foxglove_schemas.hpp"
#include "recording/run_description.hpp"
#include "run/missions.hpp"
#include "wire/sample.hpp"
#include "world/world.hpp"

namespace clew::bridge {

struct FoxgloveMessage {
  FoxgloveTopic topic = FoxgloveTopic::kScene;
  std::string json;
};

/// A run in Foxglove's words: world, robot and way-points as a scene, the scan, the frames world,
/// odom and robot, the path of the last thousand ticks, events as a log, and what the robot has
/// seen.
class FoxgloveScene {
 public:
  /// Refused: a description without a world or a robot.
  static core::Result<FoxgloveScene> create(const RunDescription& description);

  /// Where the robot was sent while it went on, all that is known of it.
  void take_changes(const std::vector<domain::Intervention>& interventions);

  /// The messages of one tick, from its samples. What does not move is in the first of them.
  std::vector<FoxgloveMessage> convert(std::uint64_t time_ns,
                                       const std::vector<SampleView>& samples);

 private:
  FoxgloveScene(world::World world, double radius_m, runtime::Bundle bundle)
      : world_(std::move(world)),
        radius_m_(radius_m),
        bundle_(std::move(bundle)),
        seen_(radius_m) {}

  /// In force at a tick.
  const GivenMission& mission_at(std::uint64_t tick) const;

  FoxgloveMessage scene(std::uint64_t time_ns);
  FoxgloveMessage scan(std::uint64_t time_ns) const;
  FoxgloveMessage transforms(std::uint64_t time_ns) const;
  FoxgloveMessage path(std::uint64_t time_ns);
  void log(std::uint64_t time_ns, std::vector<FoxgloveMessage>& messages) const;
  void see(std::uint64_t time_ns, bool has_scan, std::vector<FoxgloveMessage>& messages);

  world::World world_;
  double radius_m_;
  runtime::Bundle bundle_;
  std::vector<GivenMission> missions_;  ///< by tick, the first from the beginning on
  std::size_t interventions_ = 0;       ///< of which they are
  bool has_world_ = false;              ///< was sent
  domain::Messages now_;
  std::deque<core::Pose2> path_;
  FoxgloveGrid seen_;
};

}  // namespace clew::bridge
