// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "control/controller.hpp"
#include "control/infrared/target_term.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"

namespace clew::control {

struct InfraredExpertParameters {
  double cruise_mps = 0.2;
  double turn_mps = 0.3;
  double side_mps = 0.3;
  double far_m = 0.6;
  TargetTermParameters target;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, InfraredExpertParameters& p) {
  visit.number("cruise_mps", p.cruise_mps, "m/s", {0.0, 1.0},
               "speed of both wheels if the path ahead is free");
  visit.number("turn_mps", p.turn_mps, "m/s", {0.0, 1.0},
               "speed of the wheels against each other if an obstacle is right in front");
  visit.number("side_mps", p.side_mps, "m/s", {0.0, 1.0},
               "extra speed of one wheel if an obstacle is right beside it");
  visit.number("far_m", p.far_m, "m", {0.11, 5.0}, "obstacles farther than this are ignored");
  visit_parameters(visit, p.target);
}

/// The expert's opinion: the wheel speeds wanted for four distances, without a target. With the
/// nearness of a side n = (far - d) / (far - 0.1), clipped to 0..1,
///
///     V_L = cruise - (cruise + turn) n_ahead + side max(0, n_left - n_right)
///     V_R = cruise - (cruise - turn) n_ahead + side max(0, n_right - n_left).
WheelSpeeds expert_opinion(const InfraredExpertParameters& parameters,
                           const InfraredDistances& distances_m);

/// The documented expert that labels infrared readings for `clew train neuro-fuzzy`, as a
/// controller of its own, so that pupil and teacher can be compared. *Ours:* of their expert Wang,
/// Yang & Meng say only that the desired outputs are derived from his opinion. Ours wants what the
/// text on Tables I and II says (the shorter the distance ahead, the larger the turn, always to the
/// left; beside, away from the nearer one), but in proportion to metres: the tables with sets at
/// equal distances in readings let everything within 0.25 m pass as far, as the sensor's curve is
/// flat there. It has no state.
class InfraredExpert final : public Controller {
 public:
  using Parameters = InfraredExpertParameters;

  /// Refuses sensors that are not four infrared rangers.
  static core::Result<std::unique_ptr<InfraredExpert>> create(const Parameters& parameters,
                                                              const domain::BehaviourSetup& setup);

  InfraredExpert(const Parameters& parameters, const FourInfrareds& infrareds)
      : parameters_(parameters), infrareds_(infrareds) {}

  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override;
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            const core::Vec2& target_odom, domain::Inside& inside) const override;

 private:
  Parameters parameters_;
  FourInfrareds infrareds_;
};

}  // namespace clew::control
