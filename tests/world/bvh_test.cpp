// SPDX-License-Identifier: Apache-2.0
#include "world/bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "random_world.hpp"
#include "world/shapes.hpp"

namespace clew::world {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Box> boxes_of(const std::vector<Vec2>& points) {
  std::vector<Box> boxes;
  for (const Vec2& p : points) boxes.push_back({p.x(), p.y(), p.x(), p.y()});
  return boxes;
}

std::size_t visits_for_nearest(const std::vector<Vec2>& points, const Vec2& query,
                               double& nearest) {
  const Bvh tree(boxes_of(points));
  std::size_t visits = 0;
  nearest = kInfinity;
  tree.visit_nearest_first([&](const Box& box) { return squared_distance(query, box); }, nearest,
                           [&](std::uint32_t i) {
                             nearest =
                                 std::min(nearest, (points[tree.order()[i]] - query).squaredNorm());
                             ++visits;
                           });
  return visits;
}

TEST(Bvh, OfNothingVisitsNothing) {
  const Bvh tree(std::vector<Box>{});

  tree.visit_nearest_first([](const Box&) { return 0.0; }, kInfinity,
                           [](std::uint32_t) { FAIL(); });
}

TEST(Bvh, VisitsEachItemOnceWhenNothingIsExcluded) {
  Dice dice(1);
  std::vector<Vec2> points;
  for (int i = 0; i < 1000; ++i) points.push_back(dice.point(0.0, 1.0));
  const Bvh tree(boxes_of(points));
  std::vector<int> visited(points.size(), 0);

  tree.visit_nearest_first([](const Box&) { return 0.0; }, kInfinity,
                           [&](std::uint32_t i) { ++visited[tree.order()[i]]; });

  EXPECT_EQ(std::count(visited.begin(), visited.end(), 1), 1000);
}

TEST(Bvh, FindsTheNearestWithFewVisits) {
  Dice dice(2);
  std::vector<Vec2> points;
  for (int i = 0; i < 10000; ++i) points.push_back(dice.point(0.0, 1.0));
  for (int query = 0; query < 20; ++query) {
    const Vec2 at = dice.point(0.0, 1.0);
    double expected = kInfinity;
    for (const Vec2& p : points) expected = std::min(expected, (p - at).squaredNorm());
    double nearest = 0.0;

    const std::size_t visits = visits_for_nearest(points, at, nearest);

    EXPECT_EQ(nearest, expected);
    EXPECT_LT(visits, 60u);  // a leaf has 4 of the 10000
  }
}

TEST(Bvh, StandsItemsInTheSamePlace) {
  const std::vector<Vec2> points(10000, Vec2(1, 1));
  double nearest = 0.0;

  visits_for_nearest(points, {0, 0}, nearest);

  EXPECT_EQ(nearest, 2.0);
}

// Each split of such a row takes few items off one end: the depth must stay bounded all the same.
TEST(Bvh, StandsItemsThatDoubleTheirDistance) {
  std::vector<Vec2> points;
  for (int copy = 0; copy < 100; ++copy) {
    double x = 1e-300;
    for (int i = 0; i < 1000; ++i, x *= 2.0) points.push_back({x, 0.0});
  }
  double nearest = 0.0;

  visits_for_nearest(points, {3e10, 0.0}, nearest);

  double expected = kInfinity;
  for (const Vec2& p : points) expected = std::min(expected, (p - Vec2(3e10, 0.0)).squaredNorm());
  EXPECT_EQ(nearest, expected);
}

}  // namespace
}  // namespace clew::world
