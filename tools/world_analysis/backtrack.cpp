// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/backtrack.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace clew::world_analysis {
namespace {

constexpr double kResolution_m = 1e-3;
constexpr double kUnseen = -1.0;

class BacktrackSearch {
 public:
  BacktrackSearch(const ClearanceGrid& grid, double radius_m)
      : grid_(grid), distances_m_(grid.size(), kUnseen) {
    for (std::size_t node = 0; node < grid.size(); ++node) {
      if (grid.clearance_m(node) < radius_m) continue;
      distances_m_[node] = core::length(grid.position(node) - grid.world().target());
      farthest_m_ = std::max(farthest_m_, distances_m_[node]);
    }
    start_ = grid.nearest_free(grid.world().start().position(), radius_m);
  }

  std::optional<double> least_m() const {
    if (!start_) return std::nullopt;
    // Steps of the lattice along a way that only comes nearer may rise by as much.
    double too_little_m = kSpacing_m * std::sqrt(2.0);
    if (is_enough(too_little_m)) return 0.0;
    double enough_m = farthest_m_;
    if (!is_enough(enough_m)) return std::nullopt;
    while (enough_m - too_little_m > kResolution_m) {
      const double middle_m = 0.5 * (enough_m + too_little_m);
      (is_enough(middle_m) ? enough_m : too_little_m) = middle_m;
    }
    return enough_m;
  }

 private:
  /// Whether some way to the target never rises more than this above its lowest before.
  bool is_enough(double rise_m) const {
    const double arrived_m = std::max(grid_.world().target_radius_m(), kSpacing_m);
    std::vector<double> lowest_m(grid_.size(), kUnseen);  // of the best way so far
    std::priority_queue<std::pair<double, std::size_t>> open;
    lowest_m[*start_] = distances_m_[*start_];
    open.emplace(lowest_m[*start_], *start_);
    while (!open.empty()) {
      const auto [low_m, node] = open.top();
      open.pop();
      if (low_m < lowest_m[node]) continue;
      if (distances_m_[node] <= arrived_m) return true;
      grid_.visit_around(node, 1, [&, low = low_m](std::size_t next) {
        const double distance_m = distances_m_[next];
        if (distance_m == kUnseen || distance_m - low > rise_m) return;
        const double next_low_m = std::min(low, distance_m);
        if (next_low_m <= lowest_m[next]) return;
        lowest_m[next] = next_low_m;
        open.emplace(next_low_m, next);
      });
    }
    return false;
  }

  const ClearanceGrid& grid_;
  std::vector<double> distances_m_;  ///< from the target; kUnseen where the robot cannot be
  double farthest_m_ = 0.0;
  std::optional<std::size_t> start_;
};

}  // namespace

std::optional<double> necessary_backtrack_m(const ClearanceGrid& grid, double radius_m) {
  return BacktrackSearch(grid, radius_m).least_m();
}

}  // namespace clew::world_analysis
