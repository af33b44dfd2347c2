// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/escape.hpp"
#include "recover/wall_follower.hpp"

namespace clew::recover {

enum class LeavingRule : std::uint8_t { kNearer, kPaper };

struct ObstacleFollowingParameters {
  LeavingRule leave = LeavingRule::kNearer;
  double nearer_ratio = 0.2;
  double clear_ratio = 0.8;
  double seek_limit_m = 6.0;
  double circuit_radius_m = 0.4;
  double lost_limit_m = 6.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, ObstacleFollowingParameters& p) {
  visit.choice("leave", p.leave, {{"nearer", LeavingRule::kNearer}, {"paper", LeavingRule::kPaper}},
               "leaving rule");
  visit.number("nearer_ratio", p.nearer_ratio, "1", {0.0, 10.0}, "");
  visit.number("clear_ratio", p.clear_ratio, "1", {0.0, 1.0}, "");
  visit.number("seek_limit_m", p.seek_limit_m, "m", {0.0, 100.0}, "");
  visit.number("circuit_radius_m", p.circuit_radius_m, "m", {0.0, 10.0}, "");
  visit.number("lost_limit_m", p.lost_limit_m, "m", {0.0, 100.0}, "");
}

class ObstacleFollowing final : public Escape {
 public:
  using Parameters = ObstacleFollowingParameters;

  enum class Phase : std::uint8_t { kSeek, kTurnAbout, kFollow };
  struct State {
    Phase phase = Phase::kSeek;
    Side side = Side::kLeft;
    double turn_left_rad = 0.0;
    double phase_travel_m = 0.0;
    bool breaking = false;
    double wall_seen_travel_m = 0.0;
    double start_distance_m = 0.0;
    double best_distance_m = 0.0;
    bool circuit_started = false;
    core::Vec2 circuit_start = core::Vec2::Zero();
    double circuit_heading_rad = 0.0;
    double circuit_travel_m = 0.0;
    bool circuit_left = false;
    std::uint32_t circuits = 0;
    bool followed = false;
  };

  static core::Result<std::unique_ptr<ObstacleFollowing>> create(
      const Parameters& parameters, const domain::BehaviourSetup& setup);
  explicit ObstacleFollowing(const Parameters& parameters) : parameters_(parameters) {}

  void begin(const Situation& situation, const TrapEvidence& evidence) override;
  EscapeStatus step(const Situation& situation, domain::Guidance& guidance) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  void enter(Phase phase, const Situation& situation);
  void turn_about(const Situation& situation);
  bool may_leave(const Situation& situation) const;
  EscapeStatus follow(const Situation& situation, domain::Guidance& guidance);
  void seek(const Situation& situation);
  bool closes_circuit(const Situation& situation);

  Parameters parameters_;
  State state_;
  WallRules rules_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, ObstacleFollowing::State& s) {
  visit(s.phase, s.side, s.turn_left_rad, s.phase_travel_m, s.breaking, s.wall_seen_travel_m,
        s.start_distance_m, s.best_distance_m, s.circuit_started, s.circuit_start,
        s.circuit_heading_rad, s.circuit_travel_m, s.circuit_left, s.circuits, s.followed);
}

}  // namespace clew::recover
