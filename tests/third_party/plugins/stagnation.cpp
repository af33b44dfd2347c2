// SPDX-License-Identifier: Apache-2.0
// Says trap when the robot has come no nearer to the target for a while.
#include <limits>
#include <memory>
#include <optional>

#include "plugin/plugin.hpp"

namespace {

using namespace clew;

struct StagnationParameters {
  double progress_m = 0.5;
  double allowance_s = 30.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, StagnationParameters& p) {
  visit.number("progress_m", p.progress_m, "m", {0.01, 100.0}, "how much nearer it has to come");
  visit.number("allowance_s", p.allowance_s, "s", {0.1, 100000.0}, "within this time");
}

class Stagnation final : public recover::TrapDetector {
 public:
  using Parameters = StagnationParameters;

  /// All that it remembers. A run that is saved and loaded goes on with it.
  struct State {
    double nearest_m = std::numeric_limits<double>::max();
    recover::EarlierVisit last_progress;
  };

  static core::Result<std::unique_ptr<Stagnation>> create(const Parameters& parameters,
                                                          const domain::BehaviourSetup& setup) {
    return std::make_unique<Stagnation>(parameters, setup.tick_s);
  }
  Stagnation(const Parameters& parameters, double tick_s)
      : parameters_(parameters), tick_s_(tick_s) {}

  std::optional<recover::TrapEvidence> observe(const recover::Situation& situation) override {
    const double distance_m = situation.target_distance_m();
    if (distance_m <= state_.nearest_m - parameters_.progress_m) {
      state_.nearest_m = distance_m;
      state_.last_progress = {situation.tick, situation.pose().position(),
                              situation.odometry.travel_m, 0};
      return std::nullopt;
    }
    const auto waited = static_cast<double>(situation.tick - state_.last_progress.tick);
    if (waited * tick_s_ < parameters_.allowance_s) return std::nullopt;
    recover::EarlierVisit since = state_.last_progress;
    since.travel_m = situation.odometry.travel_m - since.travel_m;
    start_afresh();
    return recover::TrapEvidence{since, "has come no nearer to the target"};
  }

  void start_afresh() override { state_.nearest_m = std::numeric_limits<double>::max(); }
  void save(core::StateWriter& writer) const override { writer(state_); }
  void load(core::StateReader& reader) override { reader(state_); }

 private:
  Parameters parameters_;
  double tick_s_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, Stagnation::State& s) {
  visit(s.nearest_m, s.last_progress);
}

}  // namespace

CLEW_PLUGIN("stagnation", "0.1.0") {
  plugin.detector<Stagnation>("stagnation", "no nearer to the target for a while");
}
