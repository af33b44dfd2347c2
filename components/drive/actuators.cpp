// SPDX-License-Identifier: Apache-2.0
#include "drive/actuators.hpp"

#include <algorithm>
#include <cmath>

#include "core/math.hpp"

namespace clew::drive {
namespace {

// However bad the ground, the wheels move the robot a little, and not arbitrarily far.
constexpr double kLeastShare = 0.05;
constexpr double kGreatestShare = 2.0;

Actuators::State sum_of(const Legs& legs) {
  Actuators::State sum;
  for (const Leg& leg : legs) sum.add(leg);
  return sum;
}

}  // namespace

Legs Actuators::act(const Legs& legs, bool brakes, const core::Random& random) {
  const State asked = sum_of(legs);
  Legs wheels = legs;
  if (parameters_.lag_s > 0.0 && !brakes) {
    const double share = 1.0 - core::exp(-asked.duration_s / parameters_.lag_s);
    const auto follow = [share](double before, double now) {
      return before + share * (now - before);
    };
    wheels.clear();
    wheels.push_back({follow(state_.turn_rad, asked.turn_rad), follow(state_.step_m, asked.step_m),
                      asked.duration_s, follow(state_.bend_rad, asked.bend_rad)});
  }
  const double owed_m = state_.owed_m;
  state_ = sum_of(wheels);
  state_.owed_m = owed_m;
  if (!slips()) return wheels;
  const double way_m = std::fabs(state_.step_m);
  slip_ = {1.0 - parameters_.slip.m_per_m, 1.0 - parameters_.slip.rad_per_rad, 0.0};
  if (way_m > 0.0 && parameters_.slip.m_per_sqrt_m > 0.0) {
    const double chance_m =
        owed_m + parameters_.slip.m_per_sqrt_m * std::sqrt(way_m) * random.normal(3);
    const double wanted_m = slip_.way_share * way_m + chance_m;
    const double gone_m = std::clamp(wanted_m, kLeastShare * way_m, kGreatestShare * way_m);
    slip_.way_share = std::clamp(gone_m / way_m, kLeastShare, kGreatestShare);
    state_.owed_m = std::clamp(wanted_m - gone_m, -kMostOwed_m, kMostOwed_m);
  }
  if (way_m > 0.0 && parameters_.slip.rad_per_sqrt_m > 0.0) {
    slip_.error_rad = parameters_.slip.rad_per_sqrt_m * std::sqrt(way_m) * random.normal(4);
  }
  for (Leg& leg : wheels) {
    const double part = way_m > 0.0 ? std::fabs(leg.step_m) / way_m : 0.0;
    leg.turn_rad *= slip_.turn_share;
    leg.step_m *= slip_.way_share;
    leg.bend_rad = leg.bend_rad * slip_.turn_share + part * slip_.error_rad;
  }
  return wheels;
}

void Actuators::State::add(const Leg& leg) {
  turn_rad += leg.turn_rad;
  step_m += leg.step_m;
  bend_rad += leg.bend_rad;
  duration_s += leg.duration_s;
}

bool Actuators::differs(const State& asked) const {
  const bool lags = state_.turn_rad != asked.turn_rad || state_.step_m != asked.step_m ||
                    state_.bend_rad != asked.bend_rad;
  const bool slid = slip_.error_rad != 0.0 || (slip_.way_share != 1.0 && state_.step_m != 0.0);
  const bool turned_in_vain =
      slip_.turn_share != 1.0 && (state_.turn_rad != 0.0 || state_.bend_rad != 0.0);
  return lags || slid || turned_in_vain;
}

void Actuators::come_to_rest() { state_.step_m = 0.0; }

Velocities Actuators::wheels() const {
  if (!(state_.duration_s > 0.0)) return {};
  return {state_.step_m / state_.duration_s,
          (state_.turn_rad + state_.bend_rad) / state_.duration_s};
}

}  // namespace clew::drive
