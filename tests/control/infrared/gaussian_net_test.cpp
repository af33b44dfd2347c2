// SPDX-License-Identifier: Apache-2.0
#include "control/infrared/gaussian_net.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.hpp"

namespace clew::control {
namespace {

constexpr std::size_t kSets = 4;
using Net = GaussianNet<kSets>;

/// Centres in order, everything else at random: the index-th of a test.
Net random_net(std::uint64_t index) {
  const core::Random random({5, 0, 0, index});
  std::uint32_t next = 0;
  Net net;
  for (std::size_t input = 0; input < 2; ++input) {
    for (std::size_t i = 0; i < kSets; ++i) {
      net.centres[input][i] = 45.0 * (static_cast<double>(i) + 1.0) + 10.0 * random.uniform(next++);
      net.widths[input][i] = 12.0 + 15.0 * random.uniform(next++);
      for (std::size_t j = 0; j < kSets; ++j) net.outputs[i][j] = random.uniform(next++);
    }
  }
  return net;
}

/// One of the network's parameters.
struct Parameter {
  enum Kind { kCentre, kWidth, kOutput } kind;
  std::size_t row;
  std::size_t column;

  template <typename Parts>
  auto& of(Parts& parts) const {
    if (kind == kOutput) return parts.outputs[row][column];
    return (kind == kCentre ? parts.centres : parts.widths)[row][column];
  }
};

std::vector<Parameter> all_parameters() {
  std::vector<Parameter> all;
  for (std::size_t k = 0; k < kSets; ++k) {
    for (std::size_t input = 0; input < 2; ++input) {
      all.push_back({Parameter::kCentre, input, k});
      all.push_back({Parameter::kWidth, input, k});
    }
    for (std::size_t i = 0; i < kSets; ++i) all.push_back({Parameter::kOutput, i, k});
  }
  return all;
}

/// dV/dz by central differences, whose error h^2 |V'''| / 6 is far below 1e-6 here.
double numerical(const Net& net, const Parameter& parameter, double first, double second) {
  const double h = 1e-4;
  Net above = net;
  Net below = net;
  parameter.of(above) += h;
  parameter.of(below) -= h;
  return (above.infer(first, second) - below.infer(first, second)) / (2.0 * h);
}

TEST(GaussianNet, WeighsTheRulesOfTwoSetsByHand) {
  // Two sets an input, sigma 1: at the first centre the other's membership is exp(-0.5).
  GaussianNet<2> net;
  net.centres = {{{0.0, 1.0}, {0.0, 1.0}}};
  net.widths = {{{1.0, 1.0}, {1.0, 1.0}}};
  net.outputs = {{{1.0, 2.0}, {3.0, 5.0}}};

  const double e = std::exp(-0.5);

  // u = 1, e, e, e^2 for the rules 11, 12, 21, 22.
  EXPECT_NEAR(net.infer(0.0, 0.0), (1.0 + 2.0 * e + 3.0 * e + 5.0 * e * e) / ((1 + e) * (1 + e)),
              1e-14);
  // Midway all rules hold alike.
  EXPECT_NEAR(net.infer(0.5, 0.5), 11.0 / 4.0, 1e-14);
}

TEST(GaussianNet, GradientsEqualNumericalDerivatives) {
  const core::Random random({6, 0, 0, 0});
  for (std::uint32_t n = 0; n < 200; ++n) {
    const Net net = random_net(n);
    const double first = 40.0 + 150.0 * random.uniform(2 * n);
    const double second = 40.0 + 150.0 * random.uniform(2 * n + 1);

    const Net::Gradient gradient = net.gradient(first, second);

    for (const Parameter& parameter : all_parameters()) {
      EXPECT_NEAR(parameter.of(gradient), numerical(net, parameter, first, second), 1e-6)
          << "net " << n << ", kind " << parameter.kind << ", " << parameter.row << ", "
          << parameter.column;
    }
  }
}

TEST(GaussianNet, GradientsAreTheEquationsAsPrintedButForTheWidths) {
  // Eq. 9 literally: (I_1 - a_1i) R_1i A_2 / (sum u sigma^2), A_2 = sum_j (w_ij - V) R_2j.
  const Net net = random_net(3);
  const double first = 100.0;
  const double second = 140.0;
  const double v = net.infer(first, second);
  const auto membership = [&](std::size_t input, std::size_t k, double reading) {
    const double off = reading - net.centres[input][k];
    return std::exp(-off * off / (2.0 * net.widths[input][k] * net.widths[input][k]));
  };
  double sum_u = 0.0;
  double a_2 = 0.0;
  for (std::size_t j = 0; j < kSets; ++j) {
    a_2 += (net.outputs[1][j] - v) * membership(1, j, second);
    for (std::size_t i = 0; i < kSets; ++i) {
      sum_u += membership(0, i, first) * membership(1, j, second);
    }
  }

  const double off = first - net.centres[0][1];
  const double sigma = net.widths[0][1];
  const double eq_9 = off * membership(0, 1, first) * a_2 / (sum_u * sigma * sigma);

  const Net::Gradient gradient = net.gradient(first, second);
  EXPECT_NEAR(gradient.centres[0][1], eq_9, 1e-15);
  // Eq. 11 has (I - a)^2 / sigma^4 for our (I - a)^2 / sigma^3.
  EXPECT_NEAR(gradient.widths[0][1], eq_9 * off / sigma, 1e-15);
}

TEST(GaussianNet, OutputStaysWithinItsRulesForEveryByte) {
  // The narrowest sets that a file may have, far from most readings.
  Net net = random_net(1);
  for (auto& widths : net.widths) widths.fill(7.0);
  for (double first = 0.0; first <= 255.0; first += 1.0) {
    for (double second = 0.0; second <= 255.0; second += 5.0) {
      const double v = net.infer(first, second);

      ASSERT_GE(v, 0.0) << first << ", " << second;
      ASSERT_LE(v, 1.0) << first << ", " << second;
    }
  }
}

TEST(GaussianNet, KnowsWhetherItsRulesLookAtTheSecondInput) {
  Net net = random_net(2);
  EXPECT_FALSE(net.ignores_second());

  for (auto& row : net.outputs) row.fill(row[0]);

  EXPECT_TRUE(net.ignores_second());
  EXPECT_NEAR(net.infer(120.0, 50.0), net.infer(120.0, 170.0), 1e-15);
}

}  // namespace
}  // namespace clew::control
