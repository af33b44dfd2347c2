// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "control/behaviourist/behaviourist_rules.hpp"
#include "control/controller.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"

namespace clew::control {

struct FuzzyBehaviouristParameters {
  std::string rules = "pin_bender_fba";
};

template <typename Visitor>
void visit_parameters(Visitor& visit, FuzzyBehaviouristParameters& p) {
  visit.file("rules", p.rules, "rulebases", "rule base: sets, and the superposed elemental rules");
}

/// The fuzzy behaviourist approach (FBA) that Pin & Bender 1996 stand on: a purely reactive
/// controller whose rule base superposes elemental behaviours, each a direct mapping from a
/// stimulus to a response.
///
/// *Our reading:* the paper describes the approach and refers to others for the rules. Ours are
/// target bearing to turn; front distance to speed, and to a turn to the freer side; left and right
/// distance to turn and speed. Distances are the least readings in a sector: front within 25
/// degrees of the heading, left and right from there to 100 degrees.
class FuzzyBehaviourist final : public Controller {
 public:
  using Parameters = FuzzyBehaviouristParameters;

  /// Refuses a scan without beams in each of the three sectors.
  static core::Result<std::unique_ptr<FuzzyBehaviourist>> create(
      const Parameters& parameters, const domain::BehaviourSetup& setup);

  explicit FuzzyBehaviourist(BehaviouristRules rules) : rules_(std::move(rules)) {}

  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override;
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            const core::Vec2& target_odom, domain::Inside& inside) const override;

 private:
  void tell_surface(domain::Inside& inside) const;

  BehaviouristRules rules_;
  Stimuli stimuli_{};  // scratch: of the last step
};

}  // namespace clew::control
