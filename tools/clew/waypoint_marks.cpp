// SPDX-License-Identifier: Apache-2.0
#include "clew/waypoint_marks.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "runtime/goals.hpp"
#include "runtime/run_plan.hpp"
#include "wire/codec.hpp"

namespace clew::tools {
namespace {

using core::Result;
using runtime::kGoalChange;
using world::Goals;

/// The way-points of the recorded world, with other goals in the place of its own.
Result<world::Route> route_to(const runtime::Bundle& bundle, const std::optional<Goals>& goals) {
  const auto file = runtime::BundleSource(bundle).find("worlds", "world");
  if (!file.ok()) return file.error();
  const auto world = world::World::parse(file->text, file->file, goals);
  if (!world.ok()) return world.error();
  return world::Route(world->waypoints());
}

/// What the recorded graph says of its goals.
Result<std::optional<Goals>> goals_of_graph(const runtime::Bundle& bundle) {
  const auto file = runtime::BundleSource(bundle).find("graphs", "graph");
  if (!file.ok()) return file.error();
  const auto root = core::YamlNode::parse(file->text, file->file);
  if (!root.ok()) return root.error();
  const auto goals = runtime::read_goals(*root);
  if (!goals.ok()) return goals.error();
  return *goals ? std::optional((*goals)->goals) : std::nullopt;
}

}  // namespace

Result<WaypointMarks> WaypointMarks::create(const bridge::RunRecording& recording) {
  const runtime::Bundle& bundle = recording.description().bundle;
  WaypointMarks marks;
  if (!recording.description().black_box) {
    const auto goals = goals_of_graph(bundle);
    if (!goals.ok()) return goals.error();
    auto route = route_to(bundle, *goals);
    if (!route.ok()) return route.error();
    marks.missions_.push_back({0, std::move(route).value()});
  }
  for (const domain::Intervention& intervention : recording.interventions()) {
    for (const std::string& change : intervention.changes) {
      if (change.rfind(kGoalChange, 0) != 0) continue;
      auto goals = runtime::parse_goals(change.substr(std::string(kGoalChange).size()));
      if (!goals.ok()) return goals.error();
      auto route = route_to(bundle, std::move(goals).value());
      if (!route.ok()) return route.error();
      marks.missions_.push_back({intervention.tick, std::move(route).value()});
    }
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
  route.pass(state.pose_world_robot);
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
  auto samples = recording.samples({{domain::Topic::kState}});
  bridge::Codec<domain::State> codec;
  domain::State state;
  while (true) {
    const auto sample = samples.next();
    if (!sample.ok()) return sample.error();
    if (!*sample) return all;
    const auto decoded = codec.decode_unvalidated((*sample)->cdr, state);
    if (!decoded.ok()) {
      return core::Error{fmt::format("tick {}: {}", (*sample)->tick, decoded.error().message),
                         recording.path()};
    }
    const auto marks = watch->see(state);
    all.insert(all.end(), marks.begin(), marks.end());
  }
}

}  // namespace clew::tools
