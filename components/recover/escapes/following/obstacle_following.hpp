// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>
#include <string>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/escapes/escape.hpp"
#include "recover/escapes/following/leaving_rules.hpp"
#include "recover/escapes/following/loop_closure.hpp"
#include "recover/escapes/following/wall_follower.hpp"
#include "scan/seven_cones.hpp"

namespace clew::recover {

struct ObstacleFollowingParameters {
  std::string rules = "obstacle_following";
  LeavingRule leave = LeavingRule::kNearer;
  double range_m = 1.5;
  double nearer_ratio = 0.2;
  double clear_ratio = 0.8;
  double first_seek_m = 6.0;
  double seek_m = 20.0;
  double open_m = 2.0;
  double lost_wall_m = 4.0;
  double same_place_m = 0.4;
  double close_share = 0.6;
  double turn_step_rad = core::radians(30.0);
  double come_in_m = 1.2;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, ObstacleFollowingParameters& p) {
  visit.file("rules", p.rules, "rulebases", "rule base of the wall follower");
  visit.choice("leave", p.leave,
               {{"nearer", LeavingRule::kNearer},
                {"paper", LeavingRule::kPaper},
                {"bug2", LeavingRule::kBug2},
                {"distbug", LeavingRule::kDistBug},
                {"tangentbug", LeavingRule::kTangentBug}},
               "leaving rule: where it is nearer and clear, the paper's, or that of another paper");
  visit.number("range_m", p.range_m, "m", {0.1, 20.0},
               "greatest range that it uses; its distances scale with it");
  visit.number(
      "nearer_ratio", p.nearer_ratio, "1", {0.0, 10.0},
      "leave: nearer to the target than where following began, by this share of the range");
  visit.number(
      "clear_ratio", p.clear_ratio, "1", {0.0, 1.0},
      "leave: clear toward the target for this share of the range, or as far as the target");
  visit.number("first_seek_m", p.first_seek_m, "m", {0.0, 1000.0},
               "step 1: following begins after this path length, whatever side the target is on");
  visit.number("seek_m", p.seek_m, "m", {0.0, 1000.0},
               "after leaving: the escape ends after this path length");
  visit.number("open_m", p.open_m, "m", {0.0, 1000.0},
               "after leaving: the escape ends after this path length without an obstacle in view");
  visit.number("lost_wall_m", p.lost_wall_m, "m", {0.0, 1000.0},
               "the escape fails after this path length without a wall to follow");
  visit.number("same_place_m", p.same_place_m, "m", {0.01, 10.0},
               "distance below which the loop counts as closed");
  visit.number("close_share", p.close_share, "1", {0.1, 1.0},
               "distances and steps of the second loop, as share of the first one's");
  visit.angle("turn_step_deg", p.turn_step_rad, {1.0, 180.0}, "turn in a tick while turning about");
  visit.number("come_in_m", p.come_in_m, "m", {0.0, 20.0},
               "leave: within this distance of the target if it is in view and the line is free");
}

/// The distant memory's action space of Krishna & Kalra 2000, section 4.3 (DMAS). With the target
/// and the nearest obstacle on the left (case i):
///
///  1. the fuzzy rules guide the robot while the target stays on the left;
///  2. when it comes on the right while the obstacle stays on the left, the robot follows the
///     obstacle,
///  3. round its ends and bends,
///  4. until the leaving rule lets it go back to step 1.
///
/// Case ii is the mirror image. With the two on different sides (cases iii and iv) the robot first
/// turns about, toward the obstacle, until both have changed sides (turn_about_rad), and follows at
/// once. Back in step 1, target and obstacle may both have changed sides: then the mirrored case
/// goes on.
///
/// Readings of ours, where the paper is open: the target *comes on the right* behind the robot,
/// since ahead it does so whenever the robot points at it. Step 1 lasts at most first_seek_m the
/// first time, since inside a closed wall it would last for ever.
///
/// *Leaving:* by the paper, at the first break with the target on the wall's side, and the steps
/// are repeated until the robot is at the target. *Deviation,* and the default: where the robot is
/// nearer to the target than where it began to follow, and the way toward it is clear; and the
/// escape ends when no obstacle has been in view for open_m after that. Others' rules are those of
/// LeavingRules; under them, too, the escape ends in the open.
///
/// *Deviation:* the robot also leaves where it is near the target and sees nothing in the way
/// there: following keeps the target of a wall between robot and wall, and would go round it.
///
/// *Coming round* (not in the paper): after a closed circuit that shows that the obstacle lies all
/// round between robot and target the robot turns about and follows on the other side, closer, to
/// find gaps that the first circuit passed over. A second such circuit is a failure of the escape
/// and no proof that the target is unreachable: what two circuits with a few cones show depends on
/// what these see through. After a circuit that shows that the obstacle does not lie between, the
/// robot leaves where it was nearest with a clear way; if there is no such place, or it comes round
/// a second time, the escape fails. Leaving points come ever nearer to the target, also from one
/// escape to the next, so that the same trap is not left at the same place again.
class ObstacleFollowing final : public Escape {
 public:
  using Parameters = ObstacleFollowingParameters;

  enum class Phase : std::uint8_t { kSeek, kTurnAbout, kFollow };
  struct State {
    Phase phase = Phase::kSeek;
    Side wall = Side::kLeft;        ///< the side that the obstacle is on, or is to come on
    bool followed = false;          ///< since the escape began
    double phase_travel_m = 0.0;    ///< when the phase began
    double in_view_travel_m = 0.0;  ///< when an obstacle was last in view
    double wall_travel_m = 0.0;     ///< when the wall was last there
    double turn_left_rad = 0.0;     ///< of turning about
    double leave_below_m = 0.0;     ///< distance to the target that lets the robot leave
    double last_leave_m = std::numeric_limits<double>::infinity();  ///< distance to the target
    bool came_round = false;  ///< a circuit has closed that does not separate
    bool separated = false;   ///< a circuit on the other side has closed that does
  };

  /// Refuses scans without a beam in each of seven cones, and a rule base that is not well formed.
  static core::Result<std::unique_ptr<ObstacleFollowing>> create(
      const Parameters& parameters, const domain::BehaviourSetup& setup);

  ObstacleFollowing(const Parameters& parameters, const WallRules& rules,
                    const domain::BehaviourSetup& setup);

  void watch(const Situation& situation) override {
    leaving_.watch(situation.with(eyes_.see(situation.scan)));
  }
  void begin(const Situation& situation, const TrapEvidence& evidence) override;
  /// That the robot stands still.
  bool take_up(const Situation& situation, const TrapEvidence& evidence) override;
  EscapeStatus step(const Situation& situation, domain::Guidance& guidance) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  void tell_circuit(const Situation& situation, domain::Inside& inside) const;
  void enter(Phase phase, const Situation& situation);
  void begin_turning(double turn_rad, const Situation& situation);
  void begin_following(const Situation& situation);

  EscapeStatus seek(const Situation& situation);
  void turn_about(const Situation& situation, domain::Guidance& guidance);
  EscapeStatus follow(const Situation& situation, domain::Guidance& guidance);
  double turn_back_rad(const Situation& situation) const;
  EscapeStatus come_round(LoopResult result, const Situation& situation,
                          domain::Guidance& guidance);

  const WallFollower& follower() const { return state_.separated ? close_follower_ : follower_; }
  double free_toward_target_m(const Situation& situation) const;
  bool way_is_clear(const Situation& situation) const;
  bool may_come_in(const Situation& situation) const;
  bool may_leave(const Situation& situation, bool clear) const;

  Parameters parameters_;
  double radius_m_;
  WallFollower follower_;
  WallFollower close_follower_;
  scan::SevenCones eyes_;
  LoopClosure loop_;
  LeavingRules leaving_;
  State state_;        // but for the circuit and the boundary, which keep their own
  bool held_ = false;  // scratch: from take_up() to step(), in the same tick
};

template <typename Visitor>
void visit_fields(Visitor& visit, ObstacleFollowing::State& s) {
  visit(s.phase, s.wall, s.followed, s.phase_travel_m, s.in_view_travel_m, s.wall_travel_m,
        s.turn_left_rad, s.leave_below_m, s.last_leave_m, s.came_round, s.separated);
}

}  // namespace clew::recover
