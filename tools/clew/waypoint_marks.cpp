// SPDX-License-Identifier: Apache-2.0
#include "clew/waypoint_marks.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "run/missions.hpp"
#include "wire/codec.hpp"

namespace clew::tools {
namespace {

using core::Result;

}  // namespace

Result<WaypointMarks> WaypointMarks::create(const bridge::RunRecording& recording) {
  const bridge::RunDescription& description = recording.description();
  auto missions = bridge::missions_of(description.bundle, recording.interventions());
  if (!missions.ok()) return missions.error();
  WaypointMarks marks;
  for (bridge::GivenMission& mission : *missions) {
    const bool is_first = &mission == &missions->front();
    if (is_first && description.black_box) continue;
    marks.missions_.push_back({mission.tick, world::Route(std::move(mission.waypoints))});
  }
  return marks;
}

bool WaypointMarks::any() const {
  for (const Mission& mission : missions_) {
    if (mission.route.size() > 1) return true;
  }
  return false;
}

std::vector<WaypointMark> WaypointMarks::see(const domain::State& state) {
  const std::uint64_t tick = state.stamp.tick;
  while (missions_.size() > 1 && missions_[1].tick <= tick) missions_.pop_front();
  std::vector<WaypointMark> marks;
  if (missions_.empty() || missions_.front().tick > tick) return marks;
  world::Route& route = missions_.front().route;
  if (route.size() < 2) return marks;
  const std::size_t before = route.passed();
  route.pass(believed_.value_or(state.pose_world_robot));
  // The last one is the outcome's, whose radius may be the drive's.
  const bool ends = state.outcome == domain::Outcome::kReached;
  const std::size_t reached = ends ? route.size() : route.passed();
  for (std::size_t i = before; i < reached; ++i) {
    marks.push_back(
        {tick, state.stamp.sim_time_s, state.pose_world_robot.position(), i + 1, route.size()});
  }
  return marks;
}

Result<std::vector<WaypointMark>> waypoint_marks(const bridge::RunRecording& recording) {
  auto watch = WaypointMarks::create(recording);
  if (!watch.ok()) return watch.error();
  std::vector<WaypointMark> all;
  if (!watch->any()) return all;
  // In a tick, odometry comes first: topics are in the order of their names.
  auto samples = recording.samples({{domain::Topic::kOdometry, domain::Topic::kState}});
  bridge::Codec<domain::State> codec;
  bridge::Codec<domain::Odometry> odometry_codec;
  domain::State state;
  domain::Odometry odometry;
  while (true) {
    const auto sample = samples.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) return all;
    const bool believed = (*sample)->topic == domain::Topic::kOdometry;
    const auto decoded = believed ? odometry_codec.decode_unvalidated((*sample)->cdr, odometry)
                                  : codec.decode_unvalidated((*sample)->cdr, state);
    if (!decoded.ok()) {
      return core::Error{fmt::format("tick {}: {}", (*sample)->tick, decoded.error().message),
                         recording.path()};
    }
    if (believed) {
      watch->hear(odometry);
      continue;
    }
    const auto marks = watch->see(state);
    all.insert(all.end(), marks.begin(), marks.end());
  }
}

nlohmann::ordered_json waypoints_json(const std::vector<WaypointMark>& marks) {
  nlohmann::ordered_json waypoints = nlohmann::ordered_json::array();
  for (const WaypointMark& mark : marks) {
    waypoints.push_back({{"tick", mark.tick},
                         {"number", mark.number},
                         {"of", mark.of},
                         {"x_m", mark.place.x()},
                         {"y_m", mark.place.y()}});
  }
  return waypoints;
}

}  // namespace clew::tools
