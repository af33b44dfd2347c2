// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/escapes/escape.hpp"
#include "recover/escapes/following/loop_closure.hpp"
#include "recover/escapes/following/wall_follower.hpp"
#include "scan/seven_cones.hpp"

namespace clew::recover {

/// Where the T mode ends.
enum class TrackLeaving : std::uint8_t { kCollinear, kSwapped };

struct TrackModeParameters {
  std::string rules = "obstacle_following";
  TrackLeaving leave = TrackLeaving::kCollinear;
  double range_m = 1.5;
  double lost_wall_m = 4.0;
  double same_place_m = 0.4;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, TrackModeParameters& p) {
  visit.file("rules", p.rules, "rulebases", "rule base of the wall follower");
  visit.choice("leave", p.leave,
               {{"collinear", TrackLeaving::kCollinear}, {"swapped", TrackLeaving::kSwapped}},
               "on the line from where tracking began to the target, or at an end of the obstacle "
               "where the target has come back to its side");
  visit.number("range_m", p.range_m, "m", {0.1, 20.0},
               "greatest range that it uses; its distances scale with it");
  visit.number("lost_wall_m", p.lost_wall_m, "m", {0.0, 1000.0},
               "the escape fails after this path length without a wall to track");
  visit.number("same_place_m", p.same_place_m, "m", {0.01, 10.0},
               "distance below which the loop counts as closed, and the escape fails");
}

/// The track mode of Huang & Lee 1992, as Krishna & Kalra 2000, section 4.5 tell it. At the alarm,
/// at point a, the robot goes from H mode (heuristic: the controller's rules) to T mode, and tracks
/// the obstacle's contour at once. T mode ends at b,
///
/// - *collinear*, theirs: where a, b and the target c are collinear and b is between a and c;
/// - *swapped*, Krishna & Kalra's criterion in its place (figure 16(d)): at an end of the obstacle,
///   with the target on the obstacle's side, after it was on the other one.
///
/// Then H mode lasts until the next alarm: the escape has ended.
///
/// Readings of ours, where the text is open: the contour is tracked on the side on which the
/// nearest obstacle is, or the target, if none is in view. An alarm comes some ticks after the turn
/// began, when the robot may have come away from the obstacle: it turns to that side until it is
/// beside it, and a is there. It is on a line in the tick in which it crosses it. The escape fails
/// where there is no wall, and where the robot has come round.
class TrackMode final : public Escape {
 public:
  using Parameters = TrackModeParameters;

  struct State {
    Side wall = Side::kLeft;                     ///< the side that the obstacle is on
    bool at_wall = false;                        ///< it has been beside the robot since the alarm
    core::Vec2 begun_odom = core::Vec2::Zero();  ///< a
    double off_line = 0.0;                       ///< of the line a c: left > 0
    double wall_travel_m = 0.0;                  ///< when the wall was last there
    bool target_was_off = false;                 ///< on the other side than the wall, since a
  };

  /// Refuses scans without a beam in each of seven cones, and a rule base that is not well formed.
  static core::Result<std::unique_ptr<TrackMode>> create(const Parameters& parameters,
                                                         const domain::BehaviourSetup& setup);
  TrackMode(const Parameters& parameters, const WallRules& rules)
      : parameters_(parameters),
        follower_(rules),
        eyes_(parameters.range_m),
        loop_(parameters.same_place_m) {}

  void begin(const Situation& situation, const TrapEvidence& evidence) override;
  EscapeStatus step(const Situation& situation, domain::Guidance& guidance) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  void begin_tracking(const Situation& situation);
  bool may_leave(const Situation& situation, bool at_end);
  bool crosses_line(const Situation& situation);

  Parameters parameters_;
  WallFollower follower_;
  scan::SevenCones eyes_;
  LoopClosure loop_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, TrackMode::State& s) {
  visit(s.wall, s.at_wall, s.begun_odom, s.off_line, s.wall_travel_m, s.target_was_off);
}

}  // namespace clew::recover
