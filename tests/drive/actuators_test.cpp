// SPDX-License-Identifier: Apache-2.0
#include "drive/actuators.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clew::drive {
namespace {

Legs ahead(double step_m) {
  Legs legs;
  legs.push_back({0.0, step_m, 0.1, 0.0});
  return legs;
}

TEST(Actuators, SlipByChanceAlikeHoweverLongATickIs) {
  ActuatorParameters parameters;
  parameters.slip.m_per_sqrt_m = 0.2;
  // In ticks of 1 cm the way of each would vary by twice itself: most of that must wait.
  for (const int ticks : {2, 10, 100}) {
    constexpr int kRuns = 1000;
    double mean_m = 0.0;
    double variance_m2 = 0.0;
    for (std::uint64_t run = 0; run < kRuns; ++run) {
      Actuators actuators(parameters);
      double way_m = 0.0;
      for (int i = 0; i < ticks; ++i) {
        const core::Random random({run, 0, 2, static_cast<std::uint64_t>(i)});
        const double step_m = actuators.act(ahead(1.0 / ticks), false, random)[0].step_m;
        EXPECT_GE(step_m, 0.05 / ticks * (1.0 - 1e-12));
        EXPECT_LE(step_m, 2.0 / ticks * (1.0 + 1e-12));
        way_m += step_m;
      }
      mean_m += way_m / kRuns;
      variance_m2 += (way_m - 1.0) * (way_m - 1.0) / kRuns;
    }

    // Five standard errors; what the last tick still owes is left out of the sum.
    EXPECT_NEAR(mean_m, 1.0, 5.0 * 0.2 / std::sqrt(kRuns)) << ticks;
    EXPECT_NEAR(std::sqrt(variance_m2), 0.2, 0.04) << ticks;
  }
}

}  // namespace
}  // namespace clew::drive
