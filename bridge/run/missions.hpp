// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/result.hpp"
#include "domain/intervention.hpp"
#include "runtime/config_source.hpp"
#include "world/world.hpp"

namespace clew::bridge {

/// Where a run's robot was sent, from a tick on; without a way-point it waits.
struct GivenMission {
  std::uint64_t tick = 0;
  std::vector<world::Waypoint> waypoints;
};

/// The mission of a run's graph, or of its world, then those that it was given while it went on.
/// Refused: a bundle without a world, and one whose world, graph or goals cannot be read.
core::Result<std::vector<GivenMission>> missions_of(
    const runtime::Bundle& bundle, const std::vector<domain::Intervention>& interventions);

}  // namespace clew::bridge
