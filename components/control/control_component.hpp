// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/controller.hpp"
#include "control/final_approach.hpp"
#include "control/heading_turn.hpp"
#include "control/reactions/reaction.hpp"
#include "control/step_guard.hpp"
#include "runtime/component.hpp"
#include "runtime/stage.hpp"

namespace clew::control {

struct ControlParameters {
  StepGuardParameters guard;
  FinalApproachParameters approach;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, ControlParameters& p) {
  visit_parameters(visit, p.guard);
  visit_parameters(visit, p.approach);
}

/// Turns the active target and the scan into a motion. What recovery asks for is done here, not
/// in the controller, so that any escape goes with any controller: its virtual obstacles are
/// applied to the scan, its override replaces the controller's motion, *unreachable* becomes giving
/// up. Near the target the final approach steers in its place, and at the target the turn to the
/// mission's heading. The first reaction that asks for
/// another motion than these has it. The step guard has the last word.
class ControlComponent final : public runtime::Component {
 public:
  struct NamedReaction {
    std::string name;
    std::unique_ptr<Reaction> reaction;
  };

  static std::vector<runtime::PortInfo> ports();

  ControlComponent(std::unique_ptr<Controller> controller, const ControlParameters& parameters,
                   const runtime::RunSetup& setup, std::vector<NamedReaction> reactions = {});

  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;
  void tell(const runtime::TickInputs& samples, domain::Inside& inside) const override;

 private:
  /// Whose motion was taken.
  enum class Decider : std::uint8_t { kNobody, kRecovery, kHeading, kApproach, kController };

  void tell_sight(const domain::Odometry& odometry, const domain::Scan& scan,
                  domain::Inside& inside) const;
  void tell_decision(const domain::Odometry& odometry, const core::Vec2& target_odom,
                     domain::Inside& inside) const;
  void tell_reactions(const runtime::TickInputs& samples, domain::Inside& inside) const;
  void tell_guard(const domain::Motion& motion, domain::Inside& inside) const;
  std::optional<domain::Motion> react(const runtime::TickInputs& inputs);
  std::optional<domain::Motion> approach(const runtime::TickInputs& inputs,
                                         const ActiveTarget& target);
  domain::Motion steer(const runtime::TickInputs& inputs, const domain::Guidance* guidance,
                       const runtime::TickOutputs& outputs);

  std::unique_ptr<Controller> controller_;
  HeadingTurn heading_;
  FinalApproach approach_;
  StepGuard guard_;
  std::vector<NamedReaction> reactions_;
  double radius_m_;
  // Scratch, of the last step.
  domain::Scan seen_;      // the scan with virtual obstacles in it
  domain::Motion wanted_;  // before reactions and guard
  domain::Motion asked_;   // before the guard
  std::optional<std::size_t> reacted_;
  Decider decider_ = Decider::kNobody;
};

}  // namespace clew::control
