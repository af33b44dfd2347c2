// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "control/reactions/reaction.hpp"
#include "core/parameters.hpp"
#include "core/result.hpp"
#include "domain/moving_object.hpp"
#include "domain/setup.hpp"

namespace clew::control {

struct GiveWayParameters {
  double keep_m = 0.25;
  double horizon_s = 3.0;
  double object_radius_m = 0.35;
  double waiting_rad = core::radians(60.0);
};

template <typename Visitor>
void visit_parameters(Visitor& visit, GiveWayParameters& p) {
  visit.number("keep_m", p.keep_m, "m", {0.0, 2.0},
               "it gives way to what would come nearer than this");
  visit.number("horizon_s", p.horizon_s, "s", {0.1, 20.0}, "how far ahead it looks");
  visit.number("object_radius_m", p.object_radius_m, "m", {0.0, 2.0},
               "half the width that objects are taken to have");
  visit.angle("waiting_deg", p.waiting_rad, {0.0, 180.0},
              "it goes around if that turns it by less than this, and else waits");
}

/// Gives way to moving objects that *moving_objects* recognised. All of it is ours; the choice
/// among foreseen motions is that of velocity obstacles (Fiorini & Shiller 1998), with the classes
/// of objects in place of measured velocities.
///
/// Each object goes on as its class and its range pattern say (domain/moving_object.hpp), and the
/// robot as it wants to: it turns, then goes straight. If the least distance between them within
/// horizon_s leaves keep_m free, the motion may pass. Else the robot takes the motion that deviates
/// least from it and leaves so much free: another direction, of 24, that is in view and clear for
/// as far as it goes in a second, or waiting, which counts as a turn of waiting_deg. If none does,
/// it takes the one that leaves most. What recedes or stands is left to the controller.
class GiveWay final : public Reaction {
 public:
  using Parameters = GiveWayParameters;

  static core::Result<std::unique_ptr<GiveWay>> create(const Parameters& parameters,
                                                       const domain::BehaviourSetup& setup);

  GiveWay(const Parameters& parameters, const domain::BehaviourSetup& setup);

  std::optional<domain::Motion> react(const domain::Odometry& odometry, const domain::Scan& scan,
                                      const domain::Landmark& landmark,
                                      const domain::Motion& wanted) override;
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            const domain::Landmark& landmark, const domain::Motion& wanted,
            domain::Inside& inside) const override;

 private:
  static constexpr int kDirections = 24;

  /// An object that moves, from the robot's place, along the robot's axes.
  struct Mover {
    domain::MovingObject object;
    core::Vec2 centre_robot = core::Vec2::Zero();
    core::Vec2 velocity_robot_mps = core::Vec2::Zero();
  };
  /// A turn, and then straight on.
  struct Course {
    double turn_rad = 0.0;
    double speed_mps = 0.0;
  };
  /// A course, what it leaves free, and how far it is from the one that was wanted.
  struct Choice {
    Course course;
    double clearance_m = 0.0;
    double deviation_rad = 0.0;
  };

  std::vector<Mover> movers(const domain::Scan& scan, const domain::Landmark& landmark) const;
  Course course_of(const domain::Motion& motion) const;
  double clearance_m(const Course& course, const std::vector<Mover>& movers) const;
  Choice choose(const Course& wanted, const std::vector<Mover>& movers,
                const domain::Scan& scan) const;
  bool is_better(const Choice& a, const Choice& b) const;
  domain::Motion motion_of(const Course& course) const;

  Parameters parameters_;
  double radius_m_;
  double tick_s_;
  double speed_mps_;
  double turn_rate_radps_;
};

}  // namespace clew::control
