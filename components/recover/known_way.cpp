// SPDX-License-Identifier: Apache-2.0
#include "recover/known_way.hpp"

#include <algorithm>
#include <cmath>

namespace clew::recover {
namespace {

// Free room around all that was seen, wide enough to go round it.
constexpr double kMargin_m = 1.0;
// A centre this near to where the robot was held does not pass either.
constexpr double kRefused_m = 0.06;
constexpr std::size_t kMostRefused = 4096;

map::Inflation inflation_of(const KnownWayParameters& p, const SurroundingsParameters& seen,
                            double radius_m) {
  map::Inflation inflation = map::inflation_of(radius_m, seen.hit_spread_m, seen.cell_m);
  inflation.comfortable_m = radius_m + p.comfortable_m;
  inflation.narrow_cost = p.narrow_cost;
  inflation.known_cost = p.known_cost;
  inflation.suspected_cost = p.suspected_cost;
  return inflation;
}

/// What going straight costs; infinite through what is blocked, except where the way begins.
double straight_cost_m(const map::Costmap& costs, const core::Vec2& from, const core::Vec2& to) {
  const double length_m = core::length(to - from);
  const auto pieces = static_cast<int>(std::ceil(length_m / (0.5 * costs.grid.cell_m)));
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const core::Vec2 place = from + (i + 0.5) / pieces * (to - from);
    const auto cell = costs.grid.cell_at(place);
    const float cost = cell ? costs.cost[costs.grid.index(*cell)] : map::Costmap::kBlocked;
    if (cost == map::Costmap::kBlocked) return HUGE_VAL;
    sum += cost;
  }
  return pieces == 0 ? 0.0 : sum * length_m / pieces;
}

}  // namespace

KnownWay::KnownWay(const KnownWayParameters& parameters, const domain::BehaviourSetup& setup,
                   std::unique_ptr<map::PathSearch> search)
    : parameters_(parameters),
      radius_m_(setup.robot.radius_m),
      replan_ticks_(parameters.replan_s / setup.tick_s),
      search_(std::move(search)) {}

void KnownWay::make_clearance(const SurroundingsParameters& surroundings) {
  inflation_ = inflation_of(parameters_, surroundings, radius_m_);
  clearance_.emplace(inflation_, surroundings.cell_m);
}

bool KnownWay::keep_up(const Situation& situation) {
  const auto age = static_cast<double>(situation.tick - state_.planned_tick);
  if (state_.planned && age + 0.5 < replan_ticks_ && !is_cut(situation)) return false;
  plan(situation);
  return true;
}

void KnownWay::plan(const Situation& situation) {
  state_.planned = true;
  state_.planned_tick = situation.tick;
  state_.next = 1;
  state_.corners_odom.clear();
  const core::Vec2 from = situation.pose().position();
  const Surroundings& surroundings = *situation.surroundings;
  if (!clearance_) make_clearance(surroundings.parameters());
  map::Costmap& costs =
      clearance_->update(surroundings.map(), from, situation.target_odom, kMargin_m);
  close_refused(costs);
  open_own_place(costs, from);
  const auto& way =
      search_->find(costs, from, situation.target_odom, 0.8 * situation.target_radius_m);
  if (way.empty()) return;
  pull_tight(costs, way, from);
  centre_corners(surroundings.map(), costs.grid.cell_m);
}

void KnownWay::refuse(const core::Vec2& place_odom) {
  if (state_.refused_odom.size() < kMostRefused) state_.refused_odom.push_back(place_odom);
}

void KnownWay::close_refused(map::Costmap& costs) const {
  const map::Grid& grid = costs.grid;
  const auto reach = static_cast<std::int32_t>(std::ceil(kRefused_m / grid.cell_m));
  for (const core::Vec2& place : state_.refused_odom) {
    const auto middle = grid.cell_at(place);
    if (!middle) continue;
    for (std::int32_t rows = -reach; rows <= reach; ++rows) {
      for (std::int32_t columns = -reach; columns <= reach; ++columns) {
        const map::Cell cell{middle->column + columns, middle->row + rows};
        if (!grid.contains(cell) || core::length(grid.centre(cell) - place) > kRefused_m) continue;
        costs.cost[grid.index(cell)] = map::Costmap::kBlocked;
        costs.clearance[grid.index(cell)] = map::Clearance::kNone;
      }
    }
  }
}

/// Where the robot stands it can be, whatever is believed.
void KnownWay::open_own_place(map::Costmap& costs, const core::Vec2& place) {
  const auto cell = costs.grid.cell_at(place);
  if (!cell || costs.clearance[costs.grid.index(*cell)] != map::Clearance::kNone) return;
  costs.clearance[costs.grid.index(*cell)] = map::Clearance::kTouching;
  costs.cost[costs.grid.index(*cell)] = static_cast<float>(inflation_.touching_cost);
}

/// Keeps of a way from cell to cell the corners that going straight between does not cost more.
void KnownWay::pull_tight(const map::Costmap& costs, const std::vector<core::Vec2>& way,
                          const core::Vec2& from) {
  state_.corners_odom.push_back(from);
  core::Vec2 corner = from;
  double along_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const core::Vec2 before = i == 1 ? from : way[i - 1];
    // A diagonal may brush a cell that is blocked: the search has allowed it.
    const double step_m = std::min(straight_cost_m(costs, before, way[i]),
                                   inflation_.touching_cost * core::length(way[i] - before));
    if (i > 1 && straight_cost_m(costs, corner, way[i]) > 1.001 * (along_m + step_m)) {
      corner = way[i - 1];
      state_.corners_odom.push_back(corner);
      along_m = 0.0;
    }
    along_m += step_m;
  }
  state_.corners_odom.push_back(way.back());
}

/// Moves the corners between, where room is tight, to where within their cells there is most. A
/// cell's middle may lie half a cell beside that of a passage: in one that is 6 cm wider than the
/// robot the guard, which takes a cone's return to be at its near end, does not let it in there.
void KnownWay::centre_corners(const map::SeenMap& seen, double cell_m) {
  constexpr int kPlaces = 2;  // to each side
  const double reach_m = inflation_.comfortable_m + cell_m;
  for (std::size_t i = 1; i + 1 < state_.corners_odom.size(); ++i) {
    const core::Vec2 corner = state_.corners_odom[i];
    const core::Vec2 reach(reach_m, reach_m);
    hits_odom_.clear();
    seen.for_each(map::Mark::kHit, corner - reach, corner + reach,
                  [&](const core::Vec2& place) { hits_odom_.push_back(place); });
    const auto room_m = [&](const core::Vec2& place) {
      double least_m = inflation_.comfortable_m;
      for (const core::Vec2& hit : hits_odom_) {
        least_m = std::min(least_m, core::length(hit - place));
      }
      return least_m;
    };
    double most_m = room_m(corner);
    for (int y = -kPlaces; y <= kPlaces; ++y) {
      for (int x = -kPlaces; x <= kPlaces; ++x) {
        const core::Vec2 place = corner + 0.5 * cell_m / kPlaces * core::Vec2(x, y);
        const double there_m = room_m(place);
        if (there_m <= most_m) continue;
        most_m = there_m;
        state_.corners_odom[i] = place;
      }
    }
  }
}

/// Whether something that was seen lies on the next piece of the way.
bool KnownWay::is_cut(const Situation& situation) const {
  core::Vec2 from = situation.pose().position();
  double left_m = parameters_.look_ahead_m;
  const double room_m = radius_m_ - 2.0 * map::kTouching_m;
  for (std::size_t i = state_.next; i < state_.corners_odom.size() && left_m > 0.0; ++i) {
    const core::Vec2 to = state_.corners_odom[i];
    const double length_m = core::length(to - from);
    if (length_m <= 0.0) continue;
    const core::Vec2 along = (to - from) / length_m;
    const double end_m = std::min(length_m, left_m);
    const core::Vec2 end = from + end_m * along;
    const core::Vec2 margin(room_m, room_m);
    bool cut = false;
    situation.surroundings->map().for_each(
        map::Mark::kHit, from.cwiseMin(end) - margin, from.cwiseMax(end) + margin,
        [&](const core::Vec2& place) {
          const core::Vec2 off = place - from;
          const double ahead_m = std::clamp(off.dot(along), 0.0, end_m);
          cut = cut || core::length(off - ahead_m * along) < room_m;
        });
    if (cut) return true;
    left_m -= length_m;
    from = to;
  }
  return false;
}

const core::Vec2& KnownWay::next_corner(const Situation& situation, double reach_m) {
  const auto last = static_cast<std::uint32_t>(state_.corners_odom.size() - 1);
  while (state_.next < last &&
         core::distance_m(situation.pose(), state_.corners_odom[state_.next]) <= reach_m) {
    ++state_.next;
  }
  return state_.corners_odom[std::min(state_.next, last)];
}

double KnownWay::length_m(const Situation& situation) const {
  double length_m = 0.0;
  core::Vec2 from = situation.pose().position();
  for (std::size_t i = state_.next; i < state_.corners_odom.size(); ++i) {
    length_m += core::length(state_.corners_odom[i] - from);
    from = state_.corners_odom[i];
  }
  return length_m;
}

double KnownWay::rise_m(const Situation& situation) const {
  core::Vec2 from = situation.pose().position();
  double nearest_m = core::length(from - situation.target_odom);
  double rise_m = 0.0;
  for (std::size_t i = state_.next; i < state_.corners_odom.size(); ++i) {
    const core::Vec2 to = state_.corners_odom[i];
    const core::Vec2 way = to - from;
    // On a straight piece the distance falls to the foot of the target's perpendicular, then rises.
    const double square = way.dot(way);
    const double foot =
        square > 0.0 ? std::clamp((situation.target_odom - from).dot(way) / square, 0.0, 1.0) : 0.0;
    nearest_m = std::min(nearest_m, core::length(from + foot * way - situation.target_odom));
    rise_m = std::max(rise_m, core::length(to - situation.target_odom) - nearest_m);
    from = to;
  }
  return rise_m;
}

void KnownWay::save(core::StateWriter& writer) const { writer(state_); }

void KnownWay::load(core::StateReader& reader) { reader(state_); }

}  // namespace clew::recover
