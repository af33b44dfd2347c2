// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/parameters.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "plan/planner.hpp"

namespace clew::plan {

/// The subgoals that the world gives, in their order, each until the robot is as near to it as it
/// must be to the target in the end; then the target. So Lagoudakis & Maida 1999 led their robot
/// through an office (figure 9): by landmarks that a person had placed. Where the world gives none,
/// it is the mission's target from the start.
class WorldSubgoals final : public Planner {
 public:
  using Parameters = core::NoParameters;
  struct State {
    std::uint32_t next = 0;  ///< of the world's subgoals; those before have been reached
  };

  static core::Result<std::unique_ptr<WorldSubgoals>> create(const Parameters&,
                                                             const domain::BehaviourSetup&) {
    return std::make_unique<WorldSubgoals>();
  }

  Subgoal step(const Situation& situation) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override { reader(state_); }

 private:
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, WorldSubgoals::State& s) {
  visit(s.next);
}

}  // namespace clew::plan
