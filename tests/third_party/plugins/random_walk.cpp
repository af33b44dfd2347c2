// SPDX-License-Identifier: Apache-2.0
// Walks off in a random direction, keeping away from what is near: Barraquand & Latombe 1991.
#include <algorithm>
#include <memory>

#include "plugin/plugin.hpp"
#include "scan/nearest_return.hpp"

namespace {

using namespace clew;

struct RandomWalkParameters {
  double walk_m = 2.0;
  double step_m = 0.1;
  double clearance_m = 0.15;
  std::int64_t walks = 4;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, RandomWalkParameters& p) {
  visit.number("walk_m", p.walk_m, "m", {0.0, 100.0}, "length of a walk");
  visit.number("step_m", p.step_m, "m", {0.01, 1.0}, "step in a tick");
  visit.number("clearance_m", p.clearance_m, "m", {0.0, 10.0}, "turns away from what is nearer");
  visit.integer("walks", p.walks, "1", {1, 1000}, "after as many it fails");
}

class RandomWalk final : public recover::Escape {
 public:
  using Parameters = RandomWalkParameters;

  /// All that it remembers. A run that is saved and loaded goes on with it.
  struct State {
    std::int64_t walks = 0;
    double begin_travel_m = 0.0;
    double turn_left_rad = 0.0;
    std::uint64_t begin_tick = 0;
  };

  static core::Result<std::unique_ptr<RandomWalk>> create(const Parameters& parameters,
                                                          const domain::BehaviourSetup&) {
    return std::make_unique<RandomWalk>(parameters);
  }
  explicit RandomWalk(const Parameters& parameters) : parameters_(parameters) {}

  void begin(const recover::Situation& situation, const recover::TrapEvidence&) override {
    // A random number is a function of where it is used, so there is no generator to save.
    const core::Random random(core::RandomKey{1, 0, 0, situation.tick});
    ++state_.walks;
    state_.begin_tick = situation.tick;
    state_.begin_travel_m = situation.odometry.travel_m;
    state_.turn_left_rad = core::kPi * (2.0 * random.uniform(0) - 1.0);
  }

  recover::EscapeStatus step(const recover::Situation& situation,
                             domain::Guidance& guidance) override {
    if (state_.walks > parameters_.walks) {
      guidance.why = "no walks left";
      return recover::EscapeStatus::kFailed;
    }
    const double walked_m = situation.odometry.travel_m - state_.begin_travel_m;
    const bool too_long = situation.tick - state_.begin_tick > 1000;
    if (walked_m >= parameters_.walk_m || too_long) return recover::EscapeStatus::kEnded;
    guidance.why = "walks at random";
    guidance.has_override = true;
    domain::Motion& motion = guidance.override_motion;
    motion.kind = domain::CommandKind::kTurnAndStep;
    motion.turn_rad = state_.turn_left_rad;
    state_.turn_left_rad = 0.0;
    const scan::Return nearest = scan::nearest_return(situation.scan);
    if (nearest.range_m < parameters_.clearance_m || situation.odometry.blocked) {
      motion.turn_rad = nearest.bearing_rad > 0.0 ? -0.5 : 0.5;
    } else {
      motion.step_m = parameters_.step_m;
    }
    return recover::EscapeStatus::kActive;
  }

  void save(core::StateWriter& writer) const override { writer(state_); }
  void load(core::StateReader& reader) override { reader(state_); }

 private:
  Parameters parameters_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, RandomWalk::State& s) {
  visit(s.walks, s.begin_travel_m, s.turn_left_rad, s.begin_tick);
}

}  // namespace

CLEW_PLUGIN("random_walk", "0.1.0") {
  plugin.escape<RandomWalk>("random_walk", "a random walk (Barraquand & Latombe 1991)");
}
