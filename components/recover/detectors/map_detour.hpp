// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "core/result.hpp"
#include "domain/setup.hpp"
#include "map/local_path.hpp"
#include "recover/detectors/trap_detector.hpp"

namespace clew::recover {

struct MapDetourParameters {
  map::LocalPathParameters path;
  double rise_m = 0.02;
  double nearer_m = 0.3;
  double patience_s = 30.0;
  double come_in_m = 2.5;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, MapDetourParameters& p) {
  visit_parameters(visit, p.path);
  visit.number("rise_m", p.rise_m, "m", {0.0, 100.0},
               "a trap is where the known path leads away from the target by more than this");
  visit.number("nearer_m", p.nearer_m, "m", {0.01, 100.0},
               "the robot makes progress if it comes this much nearer to the target");
  visit.number("patience_s", p.patience_s, "s", {0.1, 100000.0},
               "the robot is in a trap if it makes no progress for this time");
  visit.number("come_in_m", p.come_in_m, "m", {0.0, 20.0},
               "no trap within this distance of the target if it is in view and the line is free");
}

/// Notices a trap before the robot has gone round in it: on all that was seen, the cheapest way to
/// the target first leads away from it. The depth of a trap is the persistence of a minimum of the
/// distance to the target (tools/world_analysis); this is its counterpart on what the robot knows,
/// unknown counted free. A robot whose controller cannot go the way that is known is in a trap,
/// too: it does not come nearer to the target. Neither has an earlier visit to show.
class MapDetour final : public TrapDetector {
 public:
  using Parameters = MapDetourParameters;

  static core::Result<std::unique_ptr<MapDetour>> create(const Parameters& parameters,
                                                         const domain::BehaviourSetup& setup);
  struct State {
    double least_m = std::numeric_limits<double>::infinity();  ///< distance to the target so far
    std::uint64_t progress_tick = 0;  ///< when that was last undercut, or all began afresh
    std::uint64_t tick = 0;           ///< the last
  };

  MapDetour(const Parameters& parameters, const domain::BehaviourSetup& setup);

  bool reads_local_map() const override { return true; }
  std::optional<TrapEvidence> observe(const Situation& situation) override;
  /// What was seen stays known; only the way is sought again.
  void start_afresh() override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  bool gets_on(const Situation& situation);
  bool comes_in(const Situation& situation) const;

  Parameters parameters_;
  double tick_s_;
  double radius_m_;
  map::LocalPath path_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, MapDetour::State& s) {
  visit(s.least_m, s.progress_tick, s.tick);
}

}  // namespace clew::recover
