// SPDX-License-Identifier: Apache-2.0
#include "trap_worlds/generated_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/hash128.hpp"
#include "world_analysis/clearance_grid.hpp"
#include "world_analysis/reachability.hpp"
#include "world_analysis/shortest_path.hpp"
#include "world_analysis/trap_map.hpp"

namespace clew::trap_worlds {
namespace {

constexpr std::uint32_t kMostDraws = 200;
constexpr double kMargin_m = 0.02;
constexpr double kFreeWay_m = 0.01;  // to spare on a straight way that is claimed to be free

/// What is computed of a draft.
struct Findings {
  world_analysis::Solvable solvable = world_analysis::Solvable::kUndecided;
  std::optional<double> shortest_path_m;
  double deepest_trap_m = 0.0;
  bool straight_way_hits_trap = false;
  bool straight_way_is_free = false;
};

double depth_ranges(const WorldOrder& order) {
  if (order.count < 2) return 1.0;
  const double share = static_cast<double>(order.number) / static_cast<double>(order.count - 1);
  return kLeastDepth_ranges * core::exp(share * core::log(kMostDepth_ranges / kLeastDepth_ranges));
}

/// Whether the straight way from start to target, as far as it is free, ends in a trap.
bool ends_in_trap(const world_analysis::ClearanceGrid& grid, const world_analysis::TrapMap& traps,
                  double radius_m) {
  const world::World& world = grid.world();
  const Vec2 start = world.start().position();
  const world::Sweep sweep = world.sweep_disc(start, world.target(), radius_m, grid.time_s(), 0.0);
  return traps.trap_at(start + sweep.free_fraction * (world.target() - start)).has_value();
}

bool is_straight_way_free(const world_analysis::ClearanceGrid& grid, double radius_m) {
  const world::World& world = grid.world();
  return grid.is_way_free(world.start().position(), world.target(), radius_m + kFreeWay_m);
}

Findings find_out(const world::World& world, double radius_m) {
  const auto settled_s = world_analysis::settled_time_s(world);
  CLEW_CHECK(settled_s.has_value(), "a generated world that never comes to rest: " + world.name());
  const world_analysis::ClearanceGrid grid(world, *settled_s);
  const world_analysis::TrapMap traps(grid, radius_m, kLeastTrapDepth_m);
  Findings findings;
  findings.solvable = world_analysis::is_solvable(grid, radius_m, kMargin_m);
  for (const world_analysis::Trap& trap : traps.traps()) {
    findings.deepest_trap_m = std::max(findings.deepest_trap_m, trap.depth_m);
  }
  findings.straight_way_is_free = is_straight_way_free(grid, radius_m);
  findings.straight_way_hits_trap = ends_in_trap(grid, traps, radius_m);
  if (findings.straight_way_is_free) {
    findings.shortest_path_m = core::length(world.target() - world.start().position());
  } else if (findings.solvable == world_analysis::Solvable::kYes && world.moving().empty()) {
    const auto path = world_analysis::shortest_path(grid, radius_m);
    if (path) findings.shortest_path_m = path->length_m;
  }
  return findings;
}

bool is_as_claimed(const Family& family, const WorldDraft& draft, const Findings& findings) {
  if (family.traps == TrapClaim::kFreeWay) return findings.straight_way_is_free;
  const auto wanted =
      family.solvable ? world_analysis::Solvable::kYes : world_analysis::Solvable::kNo;
  if (findings.solvable != wanted) return false;
  if (family.solvable && draft.moving.empty() && !findings.shortest_path_m) return false;
  switch (family.traps) {
    case TrapClaim::kOnTheWay:
      return findings.straight_way_hits_trap;
    case TrapClaim::kNone:
      return findings.deepest_trap_m == 0.0;
    case TrapClaim::kAny:
    case TrapClaim::kFreeWay:
    case TrapClaim::kByChance:
      break;
  }
  return true;
}

std::string trap_text(double deepest_m) {
  if (deepest_m == 0.0) return "no trap";
  if (deepest_m == world_analysis::Trap::kNoWayOut) return "a trap without a way out";
  return fmt::format("deepest trap {:.2f} m", deepest_m);
}

std::string about(const WorldOrder& order, const WorldDraft& draft, const Findings* findings) {
  const double ranges = depth_ranges(order);
  std::string text = fmt::format("{}; depth {:.2f} sensing ranges ({:.2f} m)", order.family->about,
                                 ranges, ranges * order.sensing_range_m);
  if (!draft.parameters.empty()) text += ", " + draft.parameters;
  if (findings != nullptr) text += "; " + trap_text(findings->deepest_trap_m);
  return text + fmt::format(". Seed {}, {} of {}.", order.seed, order.number + 1, order.count);
}

core::RandomKey key_of(const WorldOrder& order, std::uint32_t draw) {
  // The family by its name, so that another family in the list changes no world.
  const auto name = core::hash128(order.family->name);
  return {order.seed, static_cast<std::uint32_t>(order.number),
          static_cast<std::uint32_t>(name.low), draw};
}

}  // namespace

std::string world_name(const WorldOrder& order) {
  return fmt::format("{}-s{}-{:02}", order.family->name, order.seed, order.number + 1);
}

GeneratedWorld generate_world(const WorldOrder& order) {
  const double depth_m = depth_ranges(order) * order.sensing_range_m;
  for (std::uint32_t draw = 0; draw < kMostDraws; ++draw) {
    Dice dice(key_of(order, draw));
    WorldDraft drawn = order.family->draw(dice, depth_m);
    const bool mirrored = dice.coin();
    const double angle_rad = drawn.may_be_turned
                                 ? dice.between(-core::kPi, core::kPi)
                                 : 0.5 * core::kPi * static_cast<double>(dice.count(0, 3));
    const WorldDraft draft = placed(drawn, mirrored, angle_rad);
    WorldClaims claims;
    claims.name = world_name(order);
    claims.about = about(order, draft, nullptr);
    const auto world = world::World::parse(world_text(draft, claims), claims.name);
    if (!world.ok() || !world->check_robot_fits(order.robot_radius_m).ok()) continue;
    const Findings findings = find_out(*world, order.robot_radius_m);
    if (!is_as_claimed(*order.family, draft, findings)) continue;
    claims.about = about(order, draft, &findings);
    claims.solvable = order.family->solvable;
    claims.gives_shortest_path = findings.shortest_path_m.has_value();
    claims.shortest_path_m = findings.shortest_path_m.value_or(0.0);
    return {claims.name, world_text(draft, claims), depth_ranges(order)};
  }
  CLEW_CHECK(false, "family " + order.family->name + " gives nothing at depth " +
                        std::to_string(depth_m) + " m, seed " + std::to_string(order.seed));
  return {};
}

}  // namespace clew::trap_worlds
