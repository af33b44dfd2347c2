// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/geometry.hpp"
#include "recover/escapes/following/side.hpp"

namespace clew::recover {

/// What a closed way along an obstacle has shown.
enum class LoopResult : std::uint8_t {
  kSeparates,  ///< the obstacle lies between the robot and the target, all round
  kOpen        ///< it does not
};

/// Notices that a robot that follows an obstacle has come round, and what that proves. Say the wall
/// is on the left. Around an obstacle the robot has then turned left by 360 degrees, and the target
/// is cut off if the way went round it; inside a closed wall it has turned right by 360 degrees,
/// and the target is cut off if the way did not go round it.
///
/// The way back to the place where following began proves nothing, since that may lie off the
/// circuit: the place to come back to moves on at doubling distances (Brent 1980, "An improved
/// Monte Carlo factorization algorithm", section 2), so that some of them lie on any circuit.
class LoopClosure {
 public:
  struct State {
    core::Pose2 anchor_odom;       ///< the place to come back to
    double anchor_travel_m = 0.0;  ///< when the robot was there
    double horizon_m = 0.0;        ///< travel after which the anchor moves on
    bool away = false;             ///< the robot has been clearly elsewhere since
    double turned_rad = 0.0;       ///< heading, summed up since
    double wound_rad = 0.0;        ///< direction from robot to target, summed up since
    core::Pose2 last_odom;
    double last_target_angle_rad = 0.0;
    double nearest_clear_m = 0.0;  ///< least distance to the target where the way was clear
  };

  /// Places within `radius_m` are the same.
  explicit LoopClosure(double radius_m) : radius_m_(radius_m) {}

  /// Begins at this place.
  void begin(const core::Pose2& pose_odom, double travel_m, const core::Vec2& target_odom);

  /// Takes the next place; `clear` if the way toward the target was clear there. A result if the
  /// circuit closes here; then it begins again.
  std::optional<LoopResult> add(const core::Pose2& pose_odom, double travel_m,
                                const core::Vec2& target_odom, bool clear, Side wall);

  /// Over the circuit so far; infinite if the way was never clear.
  double nearest_clear_m() const { return state_.nearest_clear_m; }

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  void move_anchor(const core::Pose2& pose_odom, double travel_m);

  double radius_m_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, LoopClosure::State& s) {
  visit(s.anchor_odom, s.anchor_travel_m, s.horizon_m, s.away, s.turned_rad, s.wound_rad,
        s.last_odom, s.last_target_angle_rad, s.nearest_clear_m);
}

}  // namespace clew::recover
