// SPDX-License-Identifier: Apache-2.0
#include "navigator_settings.hpp"

#include <cmath>
#include <cstdio>

namespace clew_mrpt {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegrees = 180.0 / kPi;

std::string line(const char* key, double value) {
  char text[96];
  std::snprintf(text, sizeof text, "%s = %.17g\n", key, value);
  return text;
}

std::string line(const char* key, const std::string& value) {
  return std::string(key) + " = " + value + '\n';
}

/// A family of paths that the robot can follow.
std::string family(int index, const char* type, const NavigatorSettings& settings) {
  const std::string name = "PTG" + std::to_string(index) + '_';
  return line((name + "Type").c_str(), type) + line((name + "resolution").c_str(), 0.05) +
         line((name + "refDistance").c_str(), settings.look_ahead_m) +
         line((name + "num_paths").c_str(), settings.path_count) +
         line((name + "v_max_mps").c_str(), settings.speed_mps) +
         line((name + "w_max_dps").c_str(), settings.turn_rate_radps * kDegrees);
}

/// The robot as MRPT's tables of collisions want it: a polygon around its circle.
std::string shape(double radius_m) {
  constexpr int kCorners = 24;
  const double corner_m = radius_m / std::cos(kPi / kCorners);
  std::string xs;
  std::string ys;
  for (int i = 0; i < kCorners; ++i) {
    const double angle_rad = 2.0 * kPi * i / kCorners;
    char text[64];
    std::snprintf(text, sizeof text, "%.9f ", corner_m * std::cos(angle_rad));
    xs += text;
    std::snprintf(text, sizeof text, "%.9f ", corner_m * std::sin(angle_rad));
    ys += text;
  }
  return line("RobotModel_shape2D_xs", xs) + line("RobotModel_shape2D_ys", ys);
}

}  // namespace

// Three families, as MRPT's own examples have them: circles ahead, curves that end straight, and
// circles backwards, which count half. The scores and their weights are simple ones of ours: free
// way, nearness of the target, clearness, and a little for what is under way.
std::string configuration(const NavigatorSettings& settings) {
  std::string text = "[CAbstractNavigator]\n";
  // The run's own rules say when it ends.
  text += line("alarm_seems_not_approaching_target_timeout", 1e9);
  text += "[CWaypointsNavigator]\n" + line("max_distance_to_allow_skip_waypoint", -1);
  text += "[CAbstractPTGBasedReactive]\n";
  text += line("robotMax_V_mps", settings.speed_mps);
  text += line("robotMax_W_degps", settings.turn_rate_radps * kDegrees);
  text += line("holonomic_method", "mrpt::nav::" + settings.holonomic);
  text += line("motion_decider_method", std::string("mrpt::nav::CMultiObjMotionOpt_Scalarization"));
  text += line("ref_distance", settings.look_ahead_m);
  text += line("speedfilter_tau", 0.0) + line("secure_distance_start", 0.05);
  text += line("secure_distance_end", 0.20) + line("use_delays_model", std::string("false"));
  text += line("enable_obstacle_filtering", std::string("false"));
  text += line("evaluate_clearance", std::string("true"));
  text += "[CMultiObjectiveMotionOptimizerBase]\n";
  text += line("score1_name", std::string("free_way"));
  text += line("score1_formula", std::string("collision_free_distance * ptg_priority"));
  text += line("score2_name", std::string("nearness"));
  text += line("score2_formula", std::string("1 / (1 + dist_eucl_final)"));
  text += line("score3_name", std::string("under_way"));
  text += line("score3_formula", std::string("hysteresis"));
  text += line("score4_name", std::string("direction"));
  text += line("score4_formula", std::string("holo_stage_eval * ptg_priority"));
  text += line("scores_to_normalize", std::string());
  text += "[CMultiObjMotionOpt_Scalarization]\n";
  text += line("scalar_score_formula",
               std::string("0.3*free_way + 1.5*nearness + 0.1*under_way + 1.0*direction"));
  text += "[CReactiveNavigationSystem]\n";
  text += line("min_obstacles_height", -1) + line("max_obstacles_height", 1);
  text += shape(settings.radius_m);
  text += line("PTG_COUNT", 3);
  text += family(0, "CPTG_DiffDrive_C", settings) + line("PTG0_K", 1);
  text += line("PTG0_score_priority", 1.0);
  text += family(1, "CPTG_DiffDrive_alpha", settings) + line("PTG1_cte_a0v_deg", 57);
  text += line("PTG1_cte_a0w_deg", 57) + line("PTG1_score_priority", 1.0);
  text += family(2, "CPTG_DiffDrive_C", settings) + line("PTG2_K", -1);
  text += line("PTG2_score_priority", 0.5);
  return text;
}

}  // namespace clew_mrpt
