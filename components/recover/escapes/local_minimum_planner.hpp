// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/escapes/escape.hpp"
#include "recover/escapes/following/side.hpp"
#include "recover/escapes/goal_stack.hpp"

namespace clew::recover {

struct LocalMinimumPlannerParameters {
  double alpha_m = 0.6;
  double outermost_rad = core::radians(90.0);
  double ahead_rad = 0.0;
  double close_m = 0.3;
  double same_place_m = 0.3;
  double patience_s = 30.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, LocalMinimumPlannerParameters& p) {
  visit.number("alpha_m", p.alpha_m, "m", {0.0, 10.0},
               "distance from the outermost return outward to the virtual target");
  visit.angle("outermost_deg", p.outermost_rad, {1.0, 180.0},
              "greatest angle off the heading of a return that counts");
  visit.angle(
      "ahead_deg", p.ahead_rad, {0.0, 90.0},
      "a target within this angle of the heading is on neither side: the nearer wall decides");
  visit.number("close_m", p.close_m, "m", {0.01, 10.0},
               "a virtual target is reached within this distance");
  visit.number("same_place_m", p.same_place_m, "m", {0.0, 10.0},
               "virtual targets closer than this are at the same place");
  visit.number("patience_s", p.patience_s, "s", {0.1, 100000.0},
               "a virtual target is dropped if the robot does not come nearer for this time");
}

/// The local minimum planner of Nakhaeinia et al. 2015, section II.B: a stack of targets. At a trap
/// a virtual target outside takes the place of the one in force, until the robot is close to it:
///
///     VTD = RO + alpha (cos Theta_O, sin Theta_O)                            (eqs 1 to 3)
///     T = T(X_R, Y_R) R(Theta) T(-X_R, -Y_R) VTD,    Theta = RTA             (eq. 4)
///
/// RTA is the bearing of the active target; RO is the outermost return on its side: ROL on the
/// left for RTA >= 0, else ROR on the right; Theta_O is its direction from the robot; R turns about
/// the robot. Ranges are measured from the skin: RO lies the robot's radius farther off its centre.
/// *Deviation:* eq. 4's third row is misprinted.
///
/// Readings of ours: returns count up to outermost_deg off the heading, since the paper's robot
/// sees ahead in its figures; where a side has none, the end of its outermost beam stands for it. A
/// virtual target *at the same location more than once* is not pursued: the other side's, turned
/// the other way, is taken. If that was had before, too, the active target is given up. A virtual
/// target is dropped if the robot does not come nearer to it. The escape ends when the last virtual
/// target is reached, and fails when it is given up or dropped.
class LocalMinimumPlanner final : public Escape {
 public:
  using Parameters = LocalMinimumPlannerParameters;
  static constexpr std::size_t kRemembered = 64;

  struct State {
    std::deque<core::Vec2> had_odom;  ///< virtual targets, the newest kRemembered, oldest first
  };

  static core::Result<std::unique_ptr<LocalMinimumPlanner>> create(
      const Parameters& parameters, const domain::BehaviourSetup& setup);
  /// A tick lasts `tick_s`; returns lie `radius_m` farther from the robot's centre than its skin.
  LocalMinimumPlanner(const Parameters& parameters, double tick_s, double radius_m);

  void begin(const Situation& situation, const TrapEvidence& evidence) override;
  bool take_up(const Situation& situation, const TrapEvidence& evidence) override;
  EscapeStatus step(const Situation& situation, domain::Guidance& guidance) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  std::optional<core::Vec2> new_target(const Situation& situation) const;
  Side side_of(const Situation& situation, double rta_rad) const;
  core::Vec2 target_beside(const Situation& situation, Side side, double turn_rad) const;
  void remember(const core::Vec2& target_odom);
  bool was_had(const core::Vec2& target_odom) const;

  Parameters parameters_;
  double radius_m_;
  GoalStack stack_;
  State state_;  // but for the stack, which keeps its own
};

template <typename Visitor>
void visit_fields(Visitor& visit, LocalMinimumPlanner::State& s) {
  visit(s.had_odom);
}

}  // namespace clew::recover
