// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/parameters.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "plan/planner.hpp"

namespace clew::plan {

struct WorldSubgoalsParameters {
  double close_m = 0.2;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, WorldSubgoalsParameters& p) {
  visit.number("close_m", p.close_m, "m", {0.01, 10.0},
               "the next subgoal follows when the robot is within this distance of one");
}

/// The subgoals that the world gives, in their order, each until the robot is within close_m of it;
/// then the target. So Lagoudakis & Maida 1999 led their robot
/// through an office (figure 9): by landmarks that a person had placed. Where the world gives none,
/// it is the mission's target from the start.
class WorldSubgoals final : public Planner {
 public:
  using Parameters = WorldSubgoalsParameters;
  struct State {
    std::uint32_t next = 0;  ///< of the world's subgoals; those before have been reached
  };

  static core::Result<std::unique_ptr<WorldSubgoals>> create(const Parameters& parameters,
                                                             const domain::BehaviourSetup&) {
    return std::make_unique<WorldSubgoals>(parameters);
  }
  explicit WorldSubgoals(const Parameters& parameters) : parameters_(parameters) {}

  Subgoal step(const Situation& situation) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override { reader(state_); }

 private:
  Parameters parameters_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, WorldSubgoals::State& s) {
  visit(s.next);
}

}  // namespace clew::plan
