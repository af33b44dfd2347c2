// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/shortest_path.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <queue>

namespace clew::world_analysis {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr int kPulls = 20;        // rounds in which corners are pulled tight
constexpr int kHalvings = 12;     // of a pull that is blocked
constexpr int kReach = 2;         // rows and columns between an end of the path and its first node
constexpr double kNoGain = 1e-4;  // metres in a round, below which pulling ends

struct Step {
  int dx;
  int dy;
};
constexpr std::array<Step, 16> kSteps = {{{1, 0},
                                          {2, 1},
                                          {1, 1},
                                          {1, 2},
                                          {0, 1},
                                          {-1, 2},
                                          {-1, 1},
                                          {-2, 1},
                                          {-1, 0},
                                          {-2, -1},
                                          {-1, -1},
                                          {-1, -2},
                                          {0, -1},
                                          {1, -2},
                                          {1, -1},
                                          {2, -1}}};

double length_of(const std::vector<Vec2>& points) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length_m += core::length(points[i] - points[i - 1]);
  }
  return length_m;
}

/// A* from the start's nodes to one that reaches the target straight.
class LatticeSearch {
 public:
  LatticeSearch(const ClearanceGrid& grid, const Leg& leg, double radius_m)
      : grid_(grid),
        radius_m_(radius_m),
        start_(leg.from),
        target_(leg.to),
        costs_m_(grid.size(), kFar),
        before_(grid.size()),
        done_(grid.size()) {}

  /// The points of the best way, or none.
  std::vector<Vec2> run() {
    open_start();
    const std::size_t goal = grid_.nearest(target_);
    while (!open_.empty()) {
      const std::size_t node = open_.top().node;
      open_.pop();
      if (done_[node]) continue;
      done_[node] = true;
      if (is_near(node, goal) && grid_.is_way_free(grid_.position(node), target_, radius_m_)) {
        return points_to(node);
      }
      expand(node);
    }
    return {};
  }

 private:
  struct Open {
    double bound_m;
    std::size_t node;
    // The least bound first; among equal ones the first node, whatever the library.
    bool operator<(const Open& other) const {
      return bound_m != other.bound_m ? bound_m > other.bound_m : node > other.node;
    }
  };

  void open_start() {
    const std::size_t middle = grid_.nearest(start_);
    const auto open = [&](std::size_t node) {
      if (!grid_.is_way_free(start_, grid_.position(node), radius_m_)) return;
      enter(node, node, core::length(grid_.position(node) - start_));
    };
    open(middle);
    grid_.visit_around(middle, kReach, open);
  }

  void expand(std::size_t node) {
    for (const Step& step : kSteps) {
      const auto next = grid_.neighbour(node, step.dx, step.dy);
      if (!next || done_[*next] || grid_.clearance_m(*next) < radius_m_) continue;
      const double cost_m =
          costs_m_[node] + core::length(grid_.position(*next) - grid_.position(node));
      if (cost_m < costs_m_[*next] && grid_.is_way_free(node, *next, radius_m_)) {
        enter(*next, node, cost_m);
      }
    }
  }

  void enter(std::size_t node, std::size_t from, double cost_m) {
    costs_m_[node] = cost_m;
    before_[node] = from;
    open_.push({cost_m + core::length(target_ - grid_.position(node)), node});
  }

  bool is_near(std::size_t node, std::size_t goal) const {
    return core::length(grid_.position(node) - grid_.position(goal)) <= kReach * kSpacing_m;
  }

  std::vector<Vec2> points_to(std::size_t node) const {
    std::vector<Vec2> points = {target_};
    for (; before_[node] != node; node = before_[node]) points.push_back(grid_.position(node));
    points.push_back(grid_.position(node));
    points.push_back(start_);
    std::reverse(points.begin(), points.end());
    return points;
  }

  const ClearanceGrid& grid_;
  double radius_m_;
  Vec2 start_;
  Vec2 target_;
  std::vector<double> costs_m_;
  std::vector<std::size_t> before_;
  std::vector<bool> done_;
  std::priority_queue<Open> open_;
};

/// The shortest sequence of the points, first and last included, in which each sees the next.
std::vector<Vec2> shortcut(const ClearanceGrid& grid, const std::vector<Vec2>& points,
                           double radius_m) {
  std::vector<double> costs_m(points.size(), kFar);
  std::vector<std::size_t> before(points.size());
  costs_m[0] = 0.0;
  for (std::size_t to = 1; to < points.size(); ++to) {
    for (std::size_t from = to; from-- > 0;) {
      const double cost_m = costs_m[from] + core::length(points[to] - points[from]);
      if (cost_m < costs_m[to] &&
          (from + 1 == to || grid.is_way_free(points[from], points[to], radius_m))) {
        costs_m[to] = cost_m;
        before[to] = from;
      }
    }
  }
  std::vector<Vec2> kept;
  for (std::size_t i = points.size() - 1; i > 0; i = before[i]) kept.push_back(points[i]);
  kept.push_back(points[0]);
  std::reverse(kept.begin(), kept.end());
  return kept;
}

/// Moves a point as far toward the line between its neighbours as the ways to them stay free.
void pull(const ClearanceGrid& grid, const Vec2& a, Vec2& point, const Vec2& b, double radius_m) {
  const Vec2 along = b - a;
  const double squared_length = along.x() * along.x() + along.y() * along.y();
  if (squared_length == 0.0) return;
  const Vec2 offset = point - a;
  const double t =
      std::clamp((offset.x() * along.x() + offset.y() * along.y()) / squared_length, 0.0, 1.0);
  const Vec2 goal = a + t * along;
  double share = 1.0;
  for (int i = 0; i < kHalvings; ++i, share *= 0.5) {
    const Vec2 moved = point + share * (goal - point);
    if (grid.is_way_free(a, moved, radius_m) && grid.is_way_free(moved, b, radius_m)) {
      point = moved;
      return;
    }
  }
}

void pull_tight(const ClearanceGrid& grid, std::vector<Vec2>& points, double radius_m) {
  double length_m = length_of(points);
  for (int round = 0; round < kPulls; ++round) {
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      pull(grid, points[i - 1], points[i], points[i + 1], radius_m);
    }
    const double before_m = length_m;
    length_m = length_of(points);
    if (before_m - length_m < kNoGain) return;
  }
}

}  // namespace

std::optional<ShortestPath> shortest_path(const ClearanceGrid& grid, double radius_m) {
  const world::World& world = grid.world();
  const Leg whole{world.start().position(), world.target(), world.target_radius_m()};
  return shortest_path(grid, whole, radius_m);
}

std::optional<ShortestPath> shortest_path(const ClearanceGrid& grid, const Leg& leg,
                                          double radius_m) {
  std::vector<Vec2> points = LatticeSearch(grid, leg, radius_m).run();
  if (points.empty()) return std::nullopt;
  points = shortcut(grid, points, radius_m);
  pull_tight(grid, points, radius_m);
  return ShortestPath{length_of(points), points};
}

}  // namespace clew::world_analysis
