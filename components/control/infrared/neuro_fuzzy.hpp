// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "control/controller.hpp"
#include "control/infrared/neuro_fuzzy_nets.hpp"
#include "control/infrared/target_term.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"

namespace clew::control {

struct NeuroFuzzyParameters {
  std::string rules = "wang_yang_meng_trained";
  TargetTermParameters target;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, NeuroFuzzyParameters& p) {
  visit.file("rules", p.rules, "rulebases",
             "rule tables in words, or the parameters that clew train neuro-fuzzy wrote");
  visit_parameters(visit, p.target);
}

/// The neuro-fuzzy controller of Wang, Yang & Meng, section III: four infrared readings to the
/// speeds of two wheels, through four networks. It has no state.
///
/// *Deviation:* the paper's robot has no target; target_term adds one. Without it this is the
/// paper's robot, which goes ahead and turns away from what is near.
class NeuroFuzzy final : public Controller {
 public:
  using Parameters = NeuroFuzzyParameters;

  /// Refuses sensors that are not four infrared rangers.
  static core::Result<std::unique_ptr<NeuroFuzzy>> create(const Parameters& parameters,
                                                          const domain::BehaviourSetup& setup);

  NeuroFuzzy(const NeuroFuzzyNets& nets, const TargetTermParameters& target,
             const FourInfrareds& infrareds)
      : nets_(nets), target_(target), infrareds_(infrareds) {}

  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override;
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            const core::Vec2& target_odom, domain::Inside& inside) const override;

 private:
  NeuroFuzzyNets nets_;
  TargetTermParameters target_;
  FourInfrareds infrareds_;
};

}  // namespace clew::control
