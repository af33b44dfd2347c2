// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/angle.hpp"
#include "core/bounded_vector.hpp"
#include "core/geometry.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/escapes/escape.hpp"

namespace clew::recover {

struct RightOfWayParameters {
  double back_m = 1.0;
  double most_back_m = 8.0;
  double aside_m = 0.7;
  double clearance_m = 0.05;
  double hold_s = 6.0;
  double stuck_s = 4.0;
  double reach_m = 0.2;
  double progress_m = 0.1;
  double trail_spacing_m = 0.1;
  double aside_rad = core::radians(90.0);
  double second_aside_rad = core::radians(75.0);
  double third_aside_rad = core::radians(60.0);
};

template <typename Visitor>
void visit_parameters(Visitor& visit, RightOfWayParameters& p) {
  visit.number("back_m", p.back_m, "m", {0.0, 10.0}, "least way back before it goes aside");
  visit.number("most_back_m", p.most_back_m, "m", {0.0, 12.0},
               "it goes back no farther, and holds there");
  visit.number("aside_m", p.aside_m, "m", {0.0, 5.0},
               "how far it goes aside, where the scan shows so much room");
  visit.number("clearance_m", p.clearance_m, "m", {0.0, 1.0},
               "clearance beside the body on the way aside");
  visit.number("hold_s", p.hold_s, "s", {0.1, 100.0},
               "how long robot 1 holds; a robot of a higher index that many times as long");
  visit.number("stuck_s", p.stuck_s, "s", {0.1, 100.0},
               "a way back or aside without progress for so long ends, and it holds there");
  visit.number("reach_m", p.reach_m, "m", {0.01, 1.0},
               "a place on the way back, or aside, counts as reached within this distance");
  visit.number("progress_m", p.progress_m, "m", {0.01, 1.0},
               "least motion that counts as progress");
  visit.number(
      "trail_spacing_m", p.trail_spacing_m, "m", {0.01, 1.0},
      "distance between the places that it notes of the way it came; it keeps 128 of them");
  visit.angle("aside_deg", p.aside_rad, {1.0, 179.0},
              "direction, from straight ahead, in which it looks for room first, on both sides");
  visit.angle("second_aside_deg", p.second_aside_rad, {1.0, 179.0},
              "where it looks next, if there is no room");
  visit.angle("third_aside_deg", p.third_aside_rad, {1.0, 179.0}, "where it looks last");
}

/// Robots that are in each other's way, each waiting for the other: a rule of way by robot_index
/// (domain/setup.hpp). All of it is ours.
///
/// Robots tell each other nothing, so each does its part of the rule by itself. Robot 0 has the way
/// before all others: its escape ends at once, and it goes on seeking. Any other goes back on the
/// way that it came, for back_m at least and until there is room beside it, goes aside, and holds
/// for hold_s times its index. Where several give way, the one of the lowest index is the first to
/// come back, and the others are out of its way meanwhile.
class RightOfWay final : public Escape {
 public:
  using Parameters = RightOfWayParameters;

  enum class Phase : std::uint8_t { kNone, kBack, kAside, kHold };
  static constexpr std::size_t kTrailPoints = 128;
  struct TrailPoint {
    double x_m = 0.0;
    double y_m = 0.0;

    core::Vec2 position() const { return {x_m, y_m}; }
  };
  struct State {
    Phase phase = Phase::kNone;
    std::uint64_t tick = 0;           ///< of the last step at work
    std::uint64_t phase_tick = 0;     ///< when the phase began
    std::uint64_t progress_tick = 0;  ///< when it was last where it had not been
    core::Vec2 progress_odom = core::Vec2::Zero();
    double begin_travel_m = 0.0;
    core::Vec2 goal_odom = core::Vec2::Zero();                 ///< of kAside
    core::BoundedVector<TrailPoint, kTrailPoints> trail_odom;  ///< the way it came, the last behind
  };

  static core::Result<std::unique_ptr<RightOfWay>> create(const Parameters& parameters,
                                                          const domain::BehaviourSetup& setup) {
    return std::make_unique<RightOfWay>(parameters, setup);
  }
  RightOfWay(const Parameters& parameters, const domain::BehaviourSetup& setup)
      : parameters_(parameters),
        tick_s_(setup.tick_s),
        radius_m_(setup.robot.radius_m),
        robot_index_(setup.robot_index) {}

  void watch(const Situation& situation) override;
  void begin(const Situation& situation, const TrapEvidence& evidence) override;
  EscapeStatus step(const Situation& situation, domain::Guidance& guidance) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  void begin_phase(Phase phase, const Situation& situation);
  void go_back(const Situation& situation);
  bool find_room_aside(const Situation& situation);
  bool is_free(const domain::Scan& scan, double bearing_rad) const;
  bool is_stuck(const Situation& situation);
  double hold_s() const { return parameters_.hold_s * static_cast<double>(robot_index_); }
  double elapsed_s(const Situation& situation) const {
    return static_cast<double>(situation.tick - state_.phase_tick) * tick_s_;
  }

  Parameters parameters_;
  double tick_s_;
  double radius_m_;
  std::uint32_t robot_index_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, RightOfWay::TrailPoint& p) {
  visit(p.x_m, p.y_m);
}
template <typename Visitor>
void visit_fields(Visitor& visit, RightOfWay::State& s) {
  visit(s.phase, s.tick, s.phase_tick, s.progress_tick, s.progress_odom, s.begin_travel_m,
        s.goal_odom, s.trail_odom);
}

}  // namespace clew::recover
