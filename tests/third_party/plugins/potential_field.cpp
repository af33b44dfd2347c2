// SPDX-License-Identifier: Apache-2.0
// Steers by an artificial potential field: Khatib 1986.
#include <algorithm>
#include <cmath>
#include <memory>

#include "plugin/plugin.hpp"

namespace {

using namespace clew;

struct PotentialFieldParameters {
  double step_m = 0.1;
  double influence_m = 1.0;
  double repulsion = 0.02;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, PotentialFieldParameters& p) {
  visit.number("step_m", p.step_m, "m", {0.01, 1.0}, "step in a tick");
  visit.number("influence_m", p.influence_m, "m", {0.1, 10.0}, "obstacles farther off do not push");
  visit.number("repulsion", p.repulsion, "1", {0.0, 10.0}, "how hard they push");
}

class PotentialField final : public control::Controller {
 public:
  using Parameters = PotentialFieldParameters;

  static core::Result<std::unique_ptr<PotentialField>> create(const Parameters& parameters,
                                                              const domain::BehaviourSetup&) {
    return std::make_unique<PotentialField>(parameters);
  }
  explicit PotentialField(const Parameters& parameters) : parameters_(parameters) {}

  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override {
    // Forces in the robot's frame: the target pulls with 1, each near return pushes.
    const double bearing_rad = core::bearing_rad(odometry.pose_odom_robot, target_odom);
    core::Vec2 force(core::cos(bearing_rad), core::sin(bearing_rad));
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double range_m = std::max(scan.ranges_m[i], 0.05);
      if (range_m >= parameters_.influence_m || range_m >= scan.range_max_m) continue;
      const double push = parameters_.repulsion * (1.0 / range_m - 1.0 / parameters_.influence_m) /
                          (range_m * range_m);
      const double share = push / static_cast<double>(scan.ranges_m.size());
      force -= share * core::Vec2(core::cos(scan.bearing_rad(i)), core::sin(scan.bearing_rad(i)));
    }
    const double distance_m = core::distance_m(odometry.pose_odom_robot, target_odom);
    domain::Motion motion;
    motion.kind = domain::CommandKind::kTurnAndStep;
    motion.turn_rad = core::atan2(force.y(), force.x());
    motion.step_m = std::min(parameters_.step_m, distance_m);
    return motion;
  }

  // It remembers nothing.
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}

 private:
  Parameters parameters_;
};

}  // namespace

CLEW_PLUGIN("potential_field", "0.1.0") {
  plugin.controller<PotentialField>("potential_field",
                                    "an artificial potential field (Khatib 1986)");
}
