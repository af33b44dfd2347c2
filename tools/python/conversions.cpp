// SPDX-License-Identifier: Apache-2.0
/// The values that behaviours written in Python get and give.
#include "core/random.hpp"
#include "domain/messages.hpp"
#include "domain/motion_conversion.hpp"
#include "domain/setup.hpp"
#include "python/module.hpp"
#include "python/situation.hpp"
#include "world/world.hpp"

namespace clew::python {
namespace {

using domain::CommandKind;
using domain::Motion;

py::array_t<double> numbers(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

void add_poses(py::module_& module) {
  py::class_<core::Pose2>(module, "Pose")
      .def_readonly("x_m", &core::Pose2::x_m)
      .def_readonly("y_m", &core::Pose2::y_m)
      .def_readonly("heading_rad", &core::Pose2::heading_rad)
      .def("bearing_rad", [](const core::Pose2& pose, double x_m, double y_m) {
        return core::bearing_rad(pose, {x_m, y_m});
      });
  py::class_<domain::Odometry>(module, "Odometry")
      .def_readonly("pose", &domain::Odometry::pose_odom_robot)
      .def_readonly("speed_mps", &domain::Odometry::speed_mps)
      .def_readonly("turn_rate_radps", &domain::Odometry::turn_rate_radps)
      .def_readonly("travel_m", &domain::Odometry::travel_m)
      .def_readonly("blocked", &domain::Odometry::blocked)
      .def_property_readonly("contact_bearings_rad", [](const domain::Odometry& o) {
        return std::vector<double>(o.contact_bearings_rad.begin(), o.contact_bearings_rad.end());
      });
}

void add_scans(py::module_& module) {
  py::class_<domain::Scan>(module, "Scan")
      .def_property_readonly("ranges_m",
                             [](const domain::Scan& scan) { return numbers(scan.ranges_m); })
      .def_property_readonly("bearings_rad",
                             [](const domain::Scan& scan) {
                               std::vector<double> bearings(scan.ranges_m.size());
                               for (std::size_t i = 0; i < bearings.size(); ++i) {
                                 bearings[i] = scan.bearing_rad(i);
                               }
                               return numbers(bearings);
                             })
      .def_readonly("beam_width_rad", &domain::Scan::beam_width_rad)
      .def_readonly("range_max_m", &domain::Scan::range_max_m);
  py::class_<domain::Landmark>(module, "Landmark")
      .def_readwrite("spatial_class", &domain::Landmark::spatial_class)
      .def_readwrite("run_length", &domain::Landmark::run_length)
      .def_readonly("presented", &domain::Landmark::presented);
  py::class_<world::World, std::unique_ptr<world::World, py::nodelete>>(module, "SensedWorld")
      .def("cone_distance_m",
           [](const world::World& world, double x_m, double y_m, double bearing_rad,
              double half_angle_rad, double max_distance_m, double time_s) {
             return world.cone_distance_m({x_m, y_m}, core::wrap_angle_rad(bearing_rad),
                                          half_angle_rad, max_distance_m, time_s);
           });
  py::class_<core::Random>(module, "Random")
      .def("uniform", &core::Random::uniform, py::arg("index"))
      .def("normal", &core::Random::normal, py::arg("index"));
}

Motion motion_of(CommandKind kind) {
  Motion motion;
  motion.kind = kind;
  return motion;
}

void add_motions(py::module_& module) {
  py::class_<Motion>(module, "Motion")
      .def_readonly("turn_rad", &Motion::turn_rad)
      .def_readonly("step_m", &Motion::step_m)
      .def_readonly("speed_mps", &Motion::speed_mps)
      .def_readonly("turn_rate_radps", &Motion::turn_rate_radps)
      .def_readonly("left_mps", &Motion::left_mps)
      .def_readonly("right_mps", &Motion::right_mps)
      .def("as_turn_and_step", [](const Motion& motion, double tick_s, double wheel_base_m) {
        const Motion turn = domain::to_turn_and_step(motion, tick_s, wheel_base_m);
        return py::make_tuple(turn.turn_rad, turn.step_m);
      });
  module.def("stop", [] { return motion_of(CommandKind::kStop); });
  module.def("give_up", [] { return motion_of(CommandKind::kGiveUp); });
  module.def(
      "turn_and_step",
      [](double turn_rad, double step_m) {
        Motion motion = motion_of(CommandKind::kTurnAndStep);
        motion.turn_rad = core::wrap_angle_rad(turn_rad);
        motion.step_m = step_m;
        return motion;
      },
      py::arg("turn_rad"), py::arg("step_m"));
  module.def(
      "velocities",
      [](double speed_mps, double turn_rate_radps) {
        Motion motion = motion_of(CommandKind::kVelocities);
        motion.speed_mps = speed_mps;
        motion.turn_rate_radps = turn_rate_radps;
        return motion;
      },
      py::arg("speed_mps"), py::arg("turn_rate_radps"));
  module.def(
      "wheel_speeds",
      [](double left_mps, double right_mps) {
        Motion motion = motion_of(CommandKind::kWheelSpeeds);
        motion.left_mps = left_mps;
        motion.right_mps = right_mps;
        return motion;
      },
      py::arg("left_mps"), py::arg("right_mps"));
}

void add_guidance(py::module_& module) {
  py::class_<Request>(module, "Request")
      .def(py::init<>())
      .def_readwrite("target", &Request::target)
      .def_readwrite("motion", &Request::motion)
      .def_readwrite("obstacles", &Request::obstacles)
      .def_readwrite("why", &Request::why);
  py::class_<Situation>(module, "Situation")
      .def_readonly("tick", &Situation::tick)
      .def_readonly("odometry", &Situation::odometry)
      .def_readonly("scan", &Situation::scan)
      .def_readonly("landmark", &Situation::landmark)
      .def_readonly("target", &Situation::target)
      .def_readonly("pursued", &Situation::pursued)
      .def_readonly("target_radius_m", &Situation::target_radius_m)
      .def_readonly("target_distance_m", &Situation::target_distance_m)
      .def_readonly("target_bearing_rad", &Situation::target_bearing_rad);
}

}  // namespace

void add_conversions(py::module_& module) {
  add_poses(module);
  add_scans(module);
  add_motions(module);
  add_guidance(module);
}

}  // namespace clew::python
