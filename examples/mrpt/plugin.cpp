// SPDX-License-Identifier: Apache-2.0
// MRPT's reactive navigators as controllers of Clew: one behaviour for each of two methods to
// choose a direction.
#include "plugin/plugin.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <vector>

#include "navigator.hpp"
#include "navigator_settings.hpp"

namespace clew_mrpt {

template <typename Visitor>
void visit_fields(Visitor& visit, Input& input) {
  for (double& value : input.pose) visit(value);
  for (double& value : input.velocity) visit(value);
  for (double& value : input.target) visit(value);
  visit(input.obstacles);
}

}  // namespace clew_mrpt

namespace {

using namespace clew;

struct MrptParameters {
  double look_ahead_m = 4.0;
  double margin_m = 0.02;
  double paths = 121;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, MrptParameters& p) {
  visit.number("look_ahead_m", p.look_ahead_m, "m", {0.5, 20.0}, "length of the paths it weighs");
  visit.number("margin_m", p.margin_m, "m", {0.0, 0.5}, "kept free around the robot");
  visit.number("paths", p.paths, "1", {11.0, 501.0}, "paths in each of its three families");
}

/// What the navigator is given of a tick. The ends of a wide beam count, too.
clew_mrpt::Input input_of(const domain::Odometry& odometry, const domain::Scan& scan,
                          const core::Vec2& target_odom, double radius_m) {
  const core::Pose2& pose = odometry.pose_odom_robot;
  clew_mrpt::Input input;
  input.pose = {pose.x_m, pose.y_m, pose.heading_rad};
  input.velocity = {odometry.speed_mps, odometry.turn_rate_radps};
  input.target = {target_odom.x(), target_odom.y(), 0.2};
  const double half_rad = 0.5 * scan.beam_width_rad;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] >= scan.range_max_m) continue;
    const double from_centre_m = radius_m + scan.ranges_m[i];
    for (const double off_rad : {-half_rad, 0.0, half_rad}) {
      if (half_rad == 0.0 && off_rad != 0.0) continue;
      const double bearing_rad = scan.bearing_rad(i) + off_rad;
      input.obstacles.push_back(from_centre_m * core::cos(bearing_rad));
      input.obstacles.push_back(from_centre_m * core::sin(bearing_rad));
      if (half_rad == 0.0) break;
    }
  }
  return input;
}

/// `Method`: the name of the class that chooses a direction.
template <const char* Method>
class MrptNavigator final : public control::Controller {
 public:
  using Parameters = MrptParameters;

  static core::Result<std::unique_ptr<MrptNavigator>> create(const Parameters& parameters,
                                                             const domain::BehaviourSetup& setup) {
    clew_mrpt::NavigatorSettings settings;
    settings.holonomic = Method;
    settings.speed_mps = std::min(setup.limits.speed_mps, 1.0);
    settings.turn_rate_radps = std::min(setup.limits.turn_rate_radps, 2.0);
    settings.radius_m = setup.robot.radius_m + parameters.margin_m;
    settings.look_ahead_m = parameters.look_ahead_m;
    settings.path_count = std::floor(parameters.paths);
    auto controller = std::make_unique<MrptNavigator>();
    controller->settings_ = settings;
    controller->tick_s_ = setup.tick_s;
    controller->radius_m_ = setup.robot.radius_m;
    if (const std::string why = controller->begin(); !why.empty()) {
      return core::Error{"MRPT refuses: " + why};
    }
    return controller;
  }

  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override {
    inputs_.push_back(input_of(odometry, scan, target_odom, radius_m_));
    const clew_mrpt::Velocities velocities = navigator_->step(inputs_.back());
    domain::Motion motion;
    motion.kind = domain::CommandKind::kVelocities;
    motion.speed_mps = velocities[0];
    motion.turn_rate_radps = velocities[1];
    return motion;
  }

  // MRPT's navigator cannot be saved: what it was given can, and gives the same navigator again.
  void save(core::StateWriter& writer) const override {
    std::vector<clew_mrpt::Input> inputs = inputs_;
    writer(inputs);
  }
  void load(core::StateReader& reader) override {
    reader(inputs_);
    const auto finite = [](const auto& values) {
      return std::all_of(values.begin(), values.end(),
                         [](double value) { return std::isfinite(value); });
    };
    const auto sound = [&](const clew_mrpt::Input& input) {
      return finite(input.pose) && finite(input.velocity) && finite(input.target) &&
             finite(input.obstacles) && input.obstacles.size() % 2 == 0;
    };
    if (!reader.check(std::all_of(inputs_.begin(), inputs_.end(), sound), "an input is none")) {
      inputs_.clear();
    }
    const std::string why = begin();
    if (!reader.check(why.empty(), "MRPT refuses its settings")) return;
    for (const clew_mrpt::Input& input : inputs_) navigator_->step(input);
  }

 private:
  /// Makes a navigator that knows nothing yet; says why it cannot.
  std::string begin() {
    try {
      navigator_ = std::make_unique<clew_mrpt::Navigator>(settings_, tick_s_);
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }

  clew_mrpt::NavigatorSettings settings_;
  double tick_s_ = 0.1;
  double radius_m_ = 0.15;
  std::unique_ptr<clew_mrpt::Navigator> navigator_;
  std::vector<clew_mrpt::Input> inputs_;  ///< all so far
};

constexpr char kFullEval[] = "CHolonomicFullEval";
constexpr char kNearnessDiagram[] = "CHolonomicND";

}  // namespace

CLEW_PLUGIN("mrpt", "0.1.0") {
  plugin.controller<MrptNavigator<kFullEval>>(
      "mrpt_full_eval", "MRPT 2.5's reactive navigation with CHolonomicFullEval");
  plugin.controller<MrptNavigator<kNearnessDiagram>>(
      "mrpt_nd", "MRPT 2.5's reactive navigation with CHolonomicND");
}
