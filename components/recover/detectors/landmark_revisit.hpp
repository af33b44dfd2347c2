// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "core/angle.hpp"
#include "core/bounded_vector.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/detectors/pose_drift.hpp"
#include "recover/detectors/trap_detector.hpp"

namespace clew::recover {

struct LandmarkRevisitParameters {
  double match_radius_m = 0.3;
  double loop_length_m = 1.0;
  std::int64_t earlier_visits = 1;
  double heading_tolerance_rad = core::radians(180.0);
  std::int64_t capacity = 64;
  double still_s = 0.0;
  double drift_sigmas = 0.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, LandmarkRevisitParameters& p) {
  visit.number("match_radius_m", p.match_radius_m, "m", {0.0, 10.0},
               "positions closer than this are the same place");
  visit.number("loop_length_m", p.loop_length_m, "m", {0.0, 100.0},
               "least path length between two visits");
  visit.integer("earlier_visits", p.earlier_visits, "1", {1, 6},
                "number of earlier visits to the same place that prove a loop");
  visit.angle("heading_tolerance_deg", p.heading_tolerance_rad, {0.0, 180.0},
              "greatest difference of heading between visits; 180: any heading");
  visit.integer("capacity", p.capacity, "1", {1, 4096},
                "number of neurons and categories remembered; 49 and 15 in the paper");
  visit.number("still_s", p.still_s, "s", {0.0, 100000.0},
               "a robot that stays at one place for this time is trapped, too; 0: never");
  visit.number(
      "drift_sigmas", p.drift_sigmas, "1", {0.0, 5.0},
      "match_radius grows by so many standard deviations of what odometry's covariance has "
      "grown by between the visits; 0: not at all");
}

/// The distant memory of Krishna & Kalra 2000, section 4.3: each neuron and category keeps the last
/// six positions at which it won. One that wins near one of them again, after travel enough to be a
/// loop, has seen the same landmark, and not another of its kind: the robot goes round in a trap.
///
/// A category that ART has made anew has no past. The end of an escape empties all queues.
///
/// The paper says that errors of dead reckoning limit this (section 4.6). With `drift_sigmas` the
/// radius widens with odometry's own covariance.
///
/// *Deviation,* off in the paper's graph: a robot that stands still before a wall sees no landmark
/// twice, since each needs a loop. With `still_s` that is a trap, too, also for the escape at work.
class LandmarkRevisit final : public TrapDetector {
 public:
  using Parameters = LandmarkRevisitParameters;
  static constexpr std::size_t kQueueLength = 6;

  struct Visit {
    std::uint64_t tick = 0;
    core::Vec2 position_odom = core::Vec2::Zero();
    double heading_rad = 0.0;
    double travel_m = 0.0;
    PoseDrift drift;
  };
  using Queue = core::BoundedVector<Visit, kQueueLength>;  // oldest first
  using Key = std::pair<domain::Network, std::uint32_t>;
  struct State {
    std::map<Key, Queue> queues;
    core::BoundedVector<Visit, 1> stay;  ///< where the robot came to last, and when
  };

  static core::Result<std::unique_ptr<LandmarkRevisit>> create(const Parameters& parameters,
                                                               const domain::BehaviourSetup& setup);
  /// A tick lasts `tick_s`.
  explicit LandmarkRevisit(const Parameters& parameters, double tick_s = 1.0)
      : parameters_(parameters), tick_s_(tick_s) {}

  std::optional<TrapEvidence> observe(const Situation& situation) override;
  void start_afresh() override { state_ = {}; }
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  std::optional<TrapEvidence> visit(const Situation& situation,
                                    const domain::Recognition& recognition);
  double match_radius_m(const PoseDrift& now, const Visit& earlier) const;
  const Visit* find_loop(const Queue& queue, const Visit& now) const;
  std::optional<TrapEvidence> notice_standing_still(const Situation& situation);

  Parameters parameters_;
  double tick_s_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, LandmarkRevisit::Visit& v) {
  visit(v.tick, v.position_odom, v.heading_rad, v.travel_m, v.drift);
}
template <typename Visitor>
void visit_fields(Visitor& visit, LandmarkRevisit::State& s) {
  visit(s.queues, s.stay);
}

}  // namespace clew::recover
