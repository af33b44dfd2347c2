// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/archive.hpp"
#include "map/costmap.hpp"
#include "map/local_map.hpp"
#include "map/no_room.hpp"
#include "map/path_finder.hpp"

namespace clew::map {

struct LocalPathParameters {
  double replan_s = 1.0;
  double look_ahead_m = 1.0;
  double comfortable_m = 0.1;
  double narrow_cost = 2.0;
  double suspected_cost = 20.0;
  double seen_free_cost = 2.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, LocalPathParameters& p) {
  visit.number("replan_s", p.replan_s, "s", {0.0, 60.0},
               "the path is planned again after this time");
  visit.number("look_ahead_m", p.look_ahead_m, "m", {0.0, 100.0},
               "the path is planned again if a new obstacle lies on it within this distance ahead");
  visit.number(
      "comfortable_m", p.comfortable_m, "m", {0.0, 1.0},
      "inflation radius: clearance beside the body beyond this lowers the cost no further");
  visit.number("narrow_cost", p.narrow_cost, "1", {1.0, 20.0},
               "cost of a metre without any clearance beside the body");
  visit.number("known_cost", p.seen_free_cost, "1", {1.0, 100.0},
               "cost of a metre through space that was seen free; unseen space costs 1");
  visit.number("suspected_cost", p.suspected_cost, "1", {1.0, 100.0},
               "cost of a metre through suspected obstacles");
}

/// A request for a path: where the robot is, where it wants to go, on what map.
struct PathRequest {
  std::uint64_t tick = 0;
  Vec2 from = Vec2::Zero();  ///< the robot's place
  Vec2 target = Vec2::Zero();
  double target_radius_m = 0.0;
  const LocalMap& map;  ///< always the same one
  /// Of that map, for all who seek paths on it; null: each has its own.
  PathFinders* finders = nullptr;
  const NoRoom* no_room = nullptr;  ///< closes these cells besides; null: none
};

/// The path to the target over all that a robot has seen, sought again as more comes to light.
///
/// Unknown counts as free, and a suspected obstacle is costly, so a path leads there only where
/// nothing else is left; going there shows what is the case. A missing path is proof of
/// unreachability as long as nothing is refused: hits are deflated by the worst-case rounding
/// before they are inflated by the robot, and NoRoom closes only what is certain. A place that was
/// refused proves nothing.
///
/// Where nothing that was seen or is suspected is near the straight line to the target, that is the
/// path, and nothing is sought. So in the open the work does not depend on how far the target is.
/// Paths are sought within 40 m of the robot; beyond, all counts as free: a target farther off than
/// 50 m is looked for in its direction, and that no path leads there proves nothing if something
/// was seen beyond those 40 m. So a step has a bound.
class LocalPath {
 public:
  struct State {
    std::vector<Vec2> corners_odom;  ///< of the path, the robot's place then first
    std::vector<Vec2> refused_odom;  ///< where the robot tried to go and could not
    std::uint32_t next = 0;          ///< corner that the robot is on its way to
    std::uint64_t planned_tick = 0;
    bool planned = false;
  };

  /// Without a search, paths are those of least cost, repaired as more is seen.
  LocalPath(const LocalPathParameters& parameters, double radius_m, double tick_s,
            std::unique_ptr<PathSearch> search = nullptr);

  /// Seeks a path if there is none yet, the last one is old, or something seen since lies on it.
  /// True if it sought.
  bool keep_up(const PathRequest& request);
  /// Seeks a path.
  void plan(const PathRequest& request);
  /// The robot cannot get to this place, whatever is seen: it has tried.
  void refuse(const Vec2& place_odom);
  const std::vector<Vec2>& refused_odom() const { return state_.refused_odom; }
  /// What was refused is open again: it was no sight of an obstacle.
  void open_refused() { state_.refused_odom.clear(); }
  /// Forgets the path, and where the robot could not get to.
  void forget_all() { state_ = {}; }
  /// The path is void; keep_up() seeks a new one.
  void forget_path() { state_.planned = false; }

  /// What going costs within `reach_m` of the robot, as a search would find it now: for people to
  /// look at. It is made anew, so it takes as long as a first search does.
  Costmap costs_around(const PathRequest& request, double reach_m) const;

  bool exists() const { return !state_.corners_odom.empty(); }
  /// The corners, the robot's place at planning first; empty if there is no path.
  const std::vector<Vec2>& corners_odom() const { return state_.corners_odom; }
  /// The corner that a robot at `pose` must go to now, `reach_m` being near enough, but at the last
  /// one. The path exists.
  const Vec2& next_corner(const core::Pose2& pose, double reach_m);
  /// From `place` along the path.
  double length_m(const Vec2& place) const;
  /// How much farther from the target the path leads than a place on it before, from `place` on.
  double rise_m(const Vec2& place, const Vec2& target) const;

  void save(core::StateWriter& writer) const;
  void load(core::StateReader& reader);

 private:
  void choose_finder(const PathRequest& request);
  void close_tried(const PathRequest& request, const Grid& grid, CostmapBuilder& costs) const;
  void open_own_place(const Costmap& costs, const Vec2& place);
  bool is_cut(const PathRequest& request) const;
  bool is_open(const PathRequest& request) const;
  void seek(const PathRequest& request, const Vec2& goal);
  void end_within_radius(const PathRequest& request);
  void centre_corners(const SeenMap& seen, double cell_m);

  LocalPathParameters parameters_;
  double radius_m_;
  double replan_ticks_;
  std::unique_ptr<PathSearch> search_;  // until the first path is sought; then its finder has it
  std::unique_ptr<PathFinder> own_finder_;
  PathFinders own_finders_;
  PathFinder* finder_ = nullptr;  // chosen when the first path is sought
  std::vector<Vec2> hits_odom_;   // memory to work in
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, LocalPath::State& s) {
  visit(s.corners_odom, s.refused_odom, s.next, s.planned_tick, s.planned);
}

}  // namespace clew::map
