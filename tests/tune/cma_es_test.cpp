// SPDX-License-Identifier: Apache-2.0
#include "tune/cma_es.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace clew::tune {
namespace {

using Function = std::function<double(const Eigen::VectorXd&)>;

/// The best value after so many generations.
double minimum(CmaEs& search, const Function& function, std::size_t generations) {
  double best = INFINITY;
  for (std::size_t i = 0; i < generations; ++i) {
    const auto points = search.ask();
    std::vector<double> values;
    for (const auto& point : points) {
      const Eigen::VectorXd inside = CmaEs::within_cube(point);
      values.push_back(function(inside) + CmaEs::penalty(point));
      best = std::min(best, function(inside));
    }
    search.tell(points, values);
  }
  return best;
}

TEST(CmaEs, HasThePopulationOfTheTutorial) {
  EXPECT_EQ(CmaEs(1, 0.3, 1).population(), 4u);
  EXPECT_EQ(CmaEs(5, 0.3, 1).population(), 8u);
  EXPECT_EQ(CmaEs(10, 0.3, 1).population(), 10u);
}

TEST(CmaEs, FindsTheMinimumOfASphere) {
  CmaEs search(4, 0.3, 1);
  const Eigen::VectorXd goal = Eigen::Vector4d(0.2, 0.9, 0.5, 0.35);

  const double best = minimum(
      search, [&](const auto& x) { return (x - goal).squaredNorm(); }, 80);

  EXPECT_LT(best, 1e-9);
  EXPECT_LT((search.mean() - goal).norm(), 1e-4);
}

TEST(CmaEs, LearnsScalesThatDifferByAThousand) {
  // An ellipsoid turned by 45 degrees in each pair of axes; condition 1e6.
  CmaEs search(4, 0.3, 2);
  const Function ellipsoid = [](const Eigen::VectorXd& x) {
    double sum = 0.0;
    const double weights[] = {1.0, 1e2, 1e4, 1e6};
    const Eigen::Vector4d d = x - Eigen::Vector4d::Constant(0.4);
    const double turned[] = {d[0] + d[1], d[2] + d[3], d[2] - d[3], d[0] - d[1]};
    for (int i = 0; i < 4; ++i) sum += weights[i] * turned[i] * turned[i];
    return sum;
  };

  EXPECT_LT(minimum(search, ellipsoid, 200), 1e-6);
}

TEST(CmaEs, FollowsABentValley) {
  // Rosenbrock's, its minimum at (0.75, 0.75) of the cube.
  CmaEs search(2, 0.2, 3);
  const Function rosenbrock = [](const Eigen::VectorXd& x) {
    const double a = 4.0 * x[0] - 2.0;
    const double b = 4.0 * x[1] - 2.0;
    return 100.0 * (b - a * a) * (b - a * a) + (1.0 - a) * (1.0 - a);
  };

  EXPECT_LT(minimum(search, rosenbrock, 200), 1e-6);
}

TEST(CmaEs, FindsAMinimumOnTheBorder) {
  CmaEs search(3, 0.3, 4);

  minimum(
      search, [](const auto& x) { return x.sum(); }, 60);

  EXPECT_LT(CmaEs::within_cube(search.mean()).maxCoeff(), 0.02);
}

TEST(CmaEs, TakesTheSameWayForTheSameSeed) {
  CmaEs one(3, 0.3, 7);
  CmaEs two(3, 0.3, 7);
  CmaEs other(3, 0.3, 8);
  const Function sphere = [](const Eigen::VectorXd& x) { return x.squaredNorm(); };
  minimum(one, sphere, 10);
  minimum(two, sphere, 10);
  minimum(other, sphere, 10);

  EXPECT_EQ(one.mean(), two.mean());
  EXPECT_NE(one.mean(), other.mean());
}

}  // namespace
}  // namespace clew::tune
