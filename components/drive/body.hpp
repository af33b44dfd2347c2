// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/geometry.hpp"
#include "domain/messages.hpp"
#include "drive/drive_model.hpp"
#include "drive/stretch.hpp"
#include "world/world.hpp"

namespace clew::drive {

struct SafetyParameters {
  bool enabled = true;
  double margin_m = 0.005;
};

/// The robot's body in the world: a disc that is moved along the legs of a tick and swept for
/// contact on the way. The safety layer holds back its way, never its turn: a disc that turns
/// touches nothing.
///
/// The *safety layer* is independent of all other stages: it stops the disc margin_m short of what
/// it would move into, in that tick only, and counts the intervention. It cannot help when a moving
/// obstacle runs into the robot; that is counted as hit_by. Without it, contact that the robot
/// moves into stops the disc where it touches and is counted as a collision.
class Body {
 public:
  /// Everything that lasts from one tick to the next.
  struct State {
    core::Pose2 pose_world_robot;
    double speed_mps = 0.0;
    double turn_rate_radps = 0.0;
    double path_length_m = 0.0;
    std::uint32_t collisions = 0;
    std::uint32_t hit_by = 0;
    std::uint32_t safety_stops = 0;
    bool blocked = false;
    bool struck = false;  ///< a moving obstacle touched it during the last tick
    core::BoundedVector<double, domain::kMaxContacts> contact_bearings_rad;
  };

  Body(const core::Pose2& start, double radius_m, const SafetyParameters& safety);

  /// Moves through one tick, which begins at time_s.
  void move(const world::World& world, const Legs& legs, double time_s);

  const State& state() const { return state_; }
  State& state() { return state_; }

 private:
  void move_leg(const world::World& world, const Leg& leg, double time_s);
  double free_fraction(const world::World& world, const Stretch& stretch);
  bool is_struck(const world::World& world, const Stretch& stretch, double fraction) const;

  double radius_m_;
  SafetyParameters safety_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, Body::State& s) {
  visit(s.pose_world_robot, s.speed_mps, s.turn_rate_radps, s.path_length_m, s.collisions, s.hit_by,
        s.safety_stops, s.blocked, s.struck, s.contact_bearings_rad);
}

}  // namespace clew::drive
