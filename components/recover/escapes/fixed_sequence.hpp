// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/escapes/escape.hpp"

namespace clew::recover {

struct FixedSequenceParameters {
  double spin_rad = 1.57;
  double spin_rate_radps = 1.0;
  double wait_s = 5.0;
  double back_up_m = 0.3;
  double back_up_mps = 0.15;
  double allowance_s = 10.0;
  std::int64_t retries = 6;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, FixedSequenceParameters& p) {
  visit.number("spin_rad", p.spin_rad, "rad", {0.0, 6.2831}, "turn of the second action");
  visit.number("spin_rate_radps", p.spin_rate_radps, "rad/s", {0.01, 10.0},
               "turn rate of the second action");
  visit.number("wait_s", p.wait_s, "s", {0.0, 1000.0}, "rest of the third action");
  visit.number("back_up_m", p.back_up_m, "m", {0.0, 10.0}, "distance of the fourth action");
  visit.number("back_up_mps", p.back_up_mps, "m/s", {0.01, 10.0}, "speed of the fourth action");
  visit.number("allowance_s", p.allowance_s, "s", {0.1, 1000.0}, "time limit of the fourth action");
  visit.integer("retries", p.retries, "1", {1, 1000000},
                "greatest number of actions in a run; then the escape fails");
}

/// The baseline: Nav2's default behaviour tree (navigation2, nav2_bt_navigator,
/// navigate_to_pose_w_replanning_and_recovery.xml). Each trap takes the next of four actions by
/// turns - clear the maps, spin by 1.57 rad, wait 5 s, back up by 0.30 m at 0.15 m/s - and goes
/// back to seeking; after six the tree fails.
///
/// *Deviations:* there are no maps here, and what is cleared is what the detectors remember, as
/// after any escape. Nav2 drives backwards; here the robot turns about and goes ahead, since not
/// all drives go back.
class FixedSequence final : public Escape {
 public:
  using Parameters = FixedSequenceParameters;

  enum class Action : std::uint8_t { kClear, kSpin, kWait, kBackUp };
  struct State {
    Action action = Action::kBackUp;  ///< at work, or the last one
    std::int64_t taken = 0;           ///< actions so far
    std::uint64_t begin_tick = 0;     ///< of the action
    double begin_travel_m = 0.0;
    double turn_left_rad = 0.0;
  };

  static core::Result<std::unique_ptr<FixedSequence>> create(const Parameters& parameters,
                                                             const domain::BehaviourSetup& setup) {
    return std::make_unique<FixedSequence>(parameters, setup.tick_s);
  }
  /// A tick lasts `tick_s`.
  FixedSequence(const Parameters& parameters, double tick_s)
      : parameters_(parameters), tick_s_(tick_s) {}

  void begin(const Situation& situation, const TrapEvidence& evidence) override;
  EscapeStatus step(const Situation& situation, domain::Guidance& guidance) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  EscapeStatus turn(domain::Guidance& guidance);
  EscapeStatus wait(double elapsed_s, domain::Guidance& guidance);
  EscapeStatus back_up(const Situation& situation, double elapsed_s, domain::Guidance& guidance);

  Parameters parameters_;
  double tick_s_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, FixedSequence::State& s) {
  visit(s.action, s.taken, s.begin_tick, s.begin_travel_m, s.turn_left_rad);
}

}  // namespace clew::recover
