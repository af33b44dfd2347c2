// SPDX-License-Identifier: Apache-2.0
#include "map/local_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/segment.hpp"
#include "map/tight_path.hpp"

namespace clew::map {
namespace {

// A centre this near to where the robot was held does not pass either.
constexpr double kRefused_m = 0.06;
constexpr std::size_t kMostRefused = 4096;
// Paths are sought over what was seen as near as this; a target farther off than kFar_m is looked
// for in its direction, at kToward_m.
constexpr double kReach_m = 40.0;
constexpr double kToward_m = 45.0;
constexpr double kFar_m = 50.0;
// A path ends this share of the target's radius from it: so near its last corner, the robot has
// arrived.
constexpr double kArrivesWithin_ratio = 0.8;

Inflation inflation_for(const LocalPathParameters& p, const LocalMap& map, double radius_m) {
  Inflation inflation = map.inflation();
  inflation.comfortable_m = radius_m + p.comfortable_m;
  inflation.narrow_cost = p.narrow_cost;
  inflation.seen_free_cost = p.seen_free_cost;
  inflation.suspected_cost = p.suspected_cost;
  return inflation;
}

}  // namespace

LocalPath::LocalPath(const LocalPathParameters& parameters, double radius_m, double tick_s,
                     std::unique_ptr<PathSearch> search)
    : parameters_(parameters),
      radius_m_(radius_m),
      replan_ticks_(parameters.replan_s / tick_s),
      search_(std::move(search)) {}

void LocalPath::choose_finder(const PathRequest& request) {
  const Inflation inflation = inflation_for(parameters_, request.map, radius_m_);
  const double cell_m = request.map.seen().cell_m();
  if (search_) {
    own_finder_ = std::make_unique<PathFinder>(
        PathFinder{inflation, CostmapBuilder(inflation, cell_m), std::move(search_)});
    finder_ = own_finder_.get();
  } else {
    PathFinders& finders = request.finders != nullptr ? *request.finders : own_finders_;
    finder_ = &finders.with(inflation, cell_m);
  }
}

bool LocalPath::keep_up(const PathRequest& request) {
  const auto age = static_cast<double>(request.tick - state_.planned_tick);
  if (state_.planned && age + 0.5 < replan_ticks_ && !is_cut(request)) return false;
  plan(request);
  return true;
}

void LocalPath::plan(const PathRequest& request) {
  state_.planned = true;
  state_.planned_tick = request.tick;
  state_.next = 1;
  state_.corners_odom.clear();
  if (finder_ == nullptr) choose_finder(request);
  if (is_open(request)) {
    state_.corners_odom = {request.from, request.target};
    return;
  }
  const Vec2 toward = request.target - request.from;
  const double distance_m = core::length(toward);
  const bool is_far = distance_m > kFar_m;
  seek(request, is_far ? Vec2(request.from + kToward_m / distance_m * toward) : request.target);
  if (!exists()) {
    const SeenMap& seen = request.map.seen();
    const auto& tiles = seen.state().tiles;
    const bool saw_more = std::any_of(tiles.begin(), tiles.end(), [&](const auto& tile) {
      return seen.distance_m(tile.first, request.from) > kReach_m;
    });
    if (saw_more) state_.corners_odom = {request.from, request.target};
  } else if (is_far) {
    state_.corners_odom.push_back(request.target);
  } else {
    end_within_radius(request);
  }
}

/// Seeks a path to a place over what was seen within reach.
void LocalPath::seek(const PathRequest& request, const Vec2& goal) {
  const Costmap& costs =
      finder_->costs.update(request.map.seen(), request.from, goal, LocalMap::kAround_m, kReach_m);
  close_tried(request, costs.grid, finder_->costs);
  open_own_place(costs, request.from);
  const auto* path = &finder_->search->find(costs, request.from, goal,
                                            kArrivesWithin_ratio * request.target_radius_m);
  if (path->empty()) {
    // Any place within the radius lies in a cell whose middle is at most half a diagonal off.
    const double half_diagonal_m = std::sqrt(0.5) * costs.grid.cell_m;
    path = &finder_->search->find(costs, request.from, goal,
                                  request.target_radius_m + half_diagonal_m);
  }
  if (path->empty()) return;
  pull_tight(costs, *path, request.from, state_.corners_odom);
  centre_corners(request.map.seen(), costs.grid.cell_m);
}

/// Whether nothing that was seen, is suspected or was tried is near the straight line.
bool LocalPath::is_open(const PathRequest& request) const {
  const double room_m = finder_->inflation.comfortable_m;
  const auto& refused = state_.refused_odom;
  const auto is_near = [&](Mark mark) {
    return request.map.is_near(mark, request.from, request.target, room_m, LocalMap::Ends::kRound);
  };
  return std::none_of(refused.begin(), refused.end(),
                      [&](const Vec2& place) {
                        return core::distance_to_segment_m(request.from, request.target, place) <
                               room_m;
                      }) &&
         !is_near(Mark::kHit) && !is_near(Mark::kSuspected);
}

/// A cell that the radius only touches stands for the places in it that are within the radius.
void LocalPath::end_within_radius(const PathRequest& request) {
  Vec2& end = state_.corners_odom.back();
  const double within_m = kArrivesWithin_ratio * request.target_radius_m;
  const Vec2 off = end - request.target;
  const double off_m = core::length(off);
  if (off_m > within_m) end = request.target + within_m / off_m * off;
}

void LocalPath::refuse(const Vec2& place_odom) {
  if (state_.refused_odom.size() < kMostRefused) state_.refused_odom.push_back(place_odom);
}

/// Closes what the robot has tried in vain, and what it saw to have no room for it.
void LocalPath::close_tried(const PathRequest& request, const Grid& grid,
                            CostmapBuilder& costs) const {
  std::vector<Cell> cells;
  for (const Vec2& place : state_.refused_odom) {
    cells_within(grid, place, kRefused_m, cells);
    for (const Cell& cell : cells) {
      costs.overrule(grid.index(cell), Costmap::kBlocked, Clearance::kNone);
    }
  }
  if (request.no_room == nullptr) return;
  request.no_room->for_each(grid.cell_m, [&](const Vec2& middle) {
    const auto cell = grid.cell_at(middle);
    if (cell) costs.overrule(grid.index(*cell), Costmap::kBlocked, Clearance::kNone);
  });
}

Costmap LocalPath::costs_around(const PathRequest& request, double reach_m) const {
  const SeenMap& seen = request.map.seen();
  CostmapBuilder costs(inflation_for(parameters_, request.map, radius_m_), seen.cell_m());
  // What lies beyond the reach has its say in the costs within.
  const double sees_m = reach_m + LocalMap::kAround_m;
  const Costmap& around = costs.update(seen, request.from, request.from, reach_m, sees_m);
  close_tried(request, around.grid, costs);
  return around;
}

/// Where the robot stands it can be, whatever is believed.
void LocalPath::open_own_place(const Costmap& costs, const Vec2& place) {
  const auto cell = costs.grid.cell_at(place);
  if (!cell || costs.clearance[costs.grid.index(*cell)] != Clearance::kNone) return;
  finder_->costs.overrule(costs.grid.index(*cell),
                          static_cast<float>(finder_->inflation.touching_cost),
                          Clearance::kTouching);
}

/// Moves the corners between, where room is tight, to where within their cells there is most. A
/// cell's middle may lie half a cell beside that of a passage: in one that is 6 cm wider than the
/// robot the guard, which takes a cone's return to be at its near end, does not let it in there.
void LocalPath::centre_corners(const SeenMap& seen, double cell_m) {
  constexpr int kPlaces = 2;  // to each side
  const double reach_m = finder_->inflation.comfortable_m + cell_m;
  for (std::size_t i = 1; i + 1 < state_.corners_odom.size(); ++i) {
    const Vec2 corner = state_.corners_odom[i];
    const Vec2 reach(reach_m, reach_m);
    hits_odom_.clear();
    seen.for_each(Mark::kHit, corner - reach, corner + reach,
                  [&](const Vec2& place) { hits_odom_.push_back(place); });
    const auto room_m = [&](const Vec2& place) {
      double least_m = finder_->inflation.comfortable_m;
      for (const Vec2& hit : hits_odom_) {
        least_m = std::min(least_m, core::length(hit - place));
      }
      return least_m;
    };
    double most_m = room_m(corner);
    if (most_m >= finder_->inflation.comfortable_m) continue;
    for (int y = -kPlaces; y <= kPlaces; ++y) {
      for (int x = -kPlaces; x <= kPlaces; ++x) {
        const Vec2 place = corner + 0.5 * cell_m / kPlaces * Vec2(x, y);
        const double there_m = room_m(place);
        if (there_m <= most_m) continue;
        most_m = there_m;
        state_.corners_odom[i] = place;
      }
    }
  }
}

/// Whether something that was seen lies on the next piece of the path.
bool LocalPath::is_cut(const PathRequest& request) const {
  Vec2 from = request.from;
  double left_m = parameters_.look_ahead_m;
  const double room_m = radius_m_ - 2.0 * kTouching_m;
  for (std::size_t i = state_.next; i < state_.corners_odom.size() && left_m > 0.0; ++i) {
    const Vec2 to = state_.corners_odom[i];
    const double length_m = core::length(to - from);
    if (length_m <= 0.0) continue;
    const Vec2 along = (to - from) / length_m;
    const Vec2 end = from + std::min(length_m, left_m) * along;
    if (request.map.is_near(Mark::kHit, from, end, room_m, LocalMap::Ends::kRound)) return true;
    left_m -= length_m;
    from = to;
  }
  return false;
}

const Vec2& LocalPath::next_corner(const core::Pose2& pose, double reach_m) {
  CLEW_CHECK(!state_.corners_odom.empty(), "a path without corners");
  const auto last = static_cast<std::uint32_t>(state_.corners_odom.size() - 1);
  while (state_.next < last &&
         core::distance_m(pose, state_.corners_odom[state_.next]) <= reach_m) {
    ++state_.next;
  }
  return state_.corners_odom[std::min(state_.next, last)];
}

double LocalPath::length_m(const Vec2& place) const {
  double length_m = 0.0;
  Vec2 from = place;
  for (std::size_t i = state_.next; i < state_.corners_odom.size(); ++i) {
    length_m += core::length(state_.corners_odom[i] - from);
    from = state_.corners_odom[i];
  }
  return length_m;
}

double LocalPath::rise_m(const Vec2& place, const Vec2& target) const {
  Vec2 from = place;
  double nearest_m = core::length(from - target);
  double rise_m = 0.0;
  for (std::size_t i = state_.next; i < state_.corners_odom.size(); ++i) {
    const Vec2 to = state_.corners_odom[i];
    // On a straight piece the distance falls to the foot of the target's perpendicular, then rises.
    nearest_m =
        std::min(nearest_m, core::length(core::nearest_on_segment(from, to, target) - target));
    rise_m = std::max(rise_m, core::length(to - target) - nearest_m);
    from = to;
  }
  return rise_m;
}

void LocalPath::save(core::StateWriter& writer) const { writer(state_); }

void LocalPath::load(core::StateReader& reader) {
  reader(state_);
  // A path that was sought in vain has no corners, and the robot's next one is the first all the
  // same.
  const std::size_t corners = std::max<std::size_t>(state_.corners_odom.size(), 1);
  const bool valid = state_.next <= corners && state_.refused_odom.size() <= kMostRefused;
  if (!reader.check(valid, "the path has no such corner")) state_ = {};
}

}  // namespace clew::map
