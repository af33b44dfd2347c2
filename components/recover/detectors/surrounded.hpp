// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/detectors/local_ways.hpp"
#include "recover/detectors/trap_detector.hpp"

namespace clew::recover {

struct SurroundedParameters {
  double reach_ratio = 1.0;
  double clearance_m = 0.02;
  double ahead_rad = core::radians(90.0);
  double facing_rad = core::radians(60.0);
  double leg_m = 0.5;
  double again_m = 5.0;
  std::int64_t ticks = 10;
  double still_s = 15.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, SurroundedParameters& p) {
  visit.number("reach_ratio", p.reach_ratio, "1", {0.1, 1.0},
               "how far the local model reaches, as share of the sensor's range; 10 m at most");
  visit.number("clearance_m", p.clearance_m, "m", {0.0, 0.5},
               "clearance on both sides of the body along a way");
  visit.angle("ahead_deg", p.ahead_rad, {0.0, 180.0},
              "a way out within this angle of the heading leads on to a virtual target");
  visit.angle("facing_deg", p.facing_rad, {0.0, 180.0},
              "a virtual target is judged within this angle of the heading");
  visit.number("leg_m", p.leg_m, "m", {0.0, 100.0},
               "travel toward a virtual target before it is judged");
  visit.number("again_m", p.again_m, "m", {0.1, 1000.0},
               "travel after which a target that no way has connected to is judged again");
  visit.integer("ticks", p.ticks, "ticks", {1, 1000},
                "number of ticks in a row without a way that make a trap");
  visit.number("still_s", p.still_s, "s", {0.1, 10000.0},
               "a robot that stays within 0.1 m for so long is in a trap, too; longer where it is "
               "slow or its ticks are long");
}

/// The local minimum criterion of Nakhaeinia et al. 2015, section II.B: *the robot is surrounded by
/// the obstacles and there is no safe region (navigable area) in the possible robot paths that
/// connect to the target*, judged in the *local occupancy map* of section II.
///
/// Readings of ours:
/// - the local map is what was seen within the sensor's range of where the robot is now, also what
///   it has turned away from since: the model *is updated when new information is collected*. What
///   was not seen is free;
/// - a path is any way there within the map, around what stands in it, and from its rim straight to
///   the target. So a wall's end or a block in the way is no trap;
/// - *it is not required that the robot reaches exactly the virtual target, but it should move in
///   its direction*: for a virtual target the robot is in a trap only if, besides, no way leads on
///   ahead, once it has moved toward it;
/// - a robot that stands still is in one, too: its controller sees no safe region where a way seems
///   to lead on;
/// - a trap is told once: again where a path has connected in between, or after some travel.
class Surrounded final : public TrapDetector {
 public:
  using Parameters = SurroundedParameters;

  struct State {
    bool has_target = false;
    core::Vec2 target_odom = core::Vec2::Zero();    ///< the one in force, where it has one
    core::Vec2 position_odom = core::Vec2::Zero();  ///< of the tick before
    double travelled_m = 0.0;                       ///< since that target came in force, or a trap
    std::int64_t in_a_row = 0;                      ///< ticks in which no path connects
    bool told = false;                              ///< and no path has connected since
    core::Vec2 stood_odom = core::Vec2::Zero();     ///< near which it has been
    std::int64_t still = 0;                         ///< for so many ticks
    core::Vec2 mission_odom = core::Vec2::Zero();   ///< the mission's target of the tick before
    bool afresh = false;                            ///< start_afresh() was called since
  };

  /// Refuses scans that leave room between their beams, or see less than 90 degrees.
  static core::Result<std::unique_ptr<Surrounded>> create(const Parameters& parameters,
                                                          const domain::BehaviourSetup& setup);
  Surrounded(const Parameters& parameters, const domain::BehaviourSetup& setup);

  bool reads_local_map() const override { return true; }
  std::optional<TrapEvidence> observe(const Situation& situation) override;
  /// Ticks count anew. That a trap was told counts on, as an escape leads out of it or gives up;
  /// unless the mission's target is another one in the next tick.
  void start_afresh() override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  void follow(const Situation& situation);
  bool stands_still(const Situation& situation);
  bool gets_on(const Situation& situation);
  bool may_judge(const Situation& situation) const;

  Parameters parameters_;
  std::int64_t still_ticks_;
  LocalWays ways_;  // of the tick
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, Surrounded::State& s) {
  visit(s.has_target, s.target_odom, s.position_odom, s.travelled_m, s.in_a_row, s.told,
        s.stood_odom, s.still, s.mission_odom, s.afresh);
}

}  // namespace clew::recover
