// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/angle.hpp"
#include "core/bounded_vector.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/detectors/heading_window.hpp"
#include "recover/detectors/trap_detector.hpp"

namespace clew::recover {

struct OscillationParameters {
  double turn_back_rad = core::radians(120.0);
  std::int64_t turn_ticks = 20;
  double same_place_m = 1.0;
  double same_direction_rad = core::radians(60.0);
  double window_m = 30.0;
  std::int64_t repeats = 2;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, OscillationParameters& p) {
  visit.angle("turn_back_deg", p.turn_back_rad, {30.0, 180.0},
              "a change of heading of more than this is a turn back");
  visit.integer("turn_ticks", p.turn_ticks, "ticks", {1, 10000},
                "longest time that a turn back takes");
  visit.number("same_place_m", p.same_place_m, "m", {0.01, 100.0},
               "turns back closer than this are at the same place");
  visit.angle("same_direction_deg", p.same_direction_rad, {1.0, 180.0},
              "turns back whose headings differ by less than this have the same direction");
  visit.number("window_m", p.window_m, "m", {0.1, 1000.0},
               "greatest path length between two turns back that count as the same");
  visit.integer("repeats", p.repeats, "1", {1, 100},
                "number of known turns back in a row that make a trap");
}

/// Says trap when the robot turns back again where it turned back before: the oscillation against
/// the far wall of Pin & Bender 1996, figure 4, and what the oscillation timeout of ROS's move_base
/// stands for. The rule is ours.
///
/// The robot turns back where its heading changes by more than turn_back_deg within turn_ticks.
/// Where it does so `repeats` times in a row at a place and in a direction in which it turned back
/// before, it oscillates; the evidence is the earlier turn back of the last of them. The turns in
/// between are any number: with a controller that prefers a side, a limit cycle has three rather
/// than two. A robot that goes round and round without turning back does not oscillate.
class Oscillation final : public TrapDetector {
 public:
  using Parameters = OscillationParameters;
  static constexpr std::size_t kTurns = 8;

  struct Turn {
    std::uint64_t tick = 0;
    core::Pose2 pose_odom;
    double travel_m = 0.0;
  };
  struct State {
    core::BoundedVector<Turn, kTurns> turns;  ///< back, the last ones, oldest first
    std::int64_t in_a_row = 0;                ///< that were made before
  };

  static core::Result<std::unique_ptr<Oscillation>> create(const Parameters& parameters,
                                                           const domain::BehaviourSetup&) {
    return std::make_unique<Oscillation>(parameters);
  }
  explicit Oscillation(const Parameters& parameters)
      : parameters_(parameters), window_(static_cast<std::size_t>(parameters.turn_ticks)) {}

  std::optional<TrapEvidence> observe(const Situation& situation) override;
  void start_afresh() override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  bool same(const Turn& a, const Turn& b) const;

  Parameters parameters_;
  HeadingWindow window_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, Oscillation::Turn& t) {
  visit(t.tick, t.pose_odom, t.travel_m);
}
template <typename Visitor>
void visit_fields(Visitor& visit, Oscillation::State& s) {
  visit(s.turns, s.in_a_row);
}

}  // namespace clew::recover
