// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/detectors/trap_detector.hpp"

namespace clew::recover {

/// What progress is measured by.
enum class Progress : std::uint8_t { kMovement, kTarget };

struct NoProgressParameters {
  Progress of = Progress::kMovement;
  double radius_m = 0.5;
  double allowance_s = 10.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, NoProgressParameters& p) {
  visit.choice("of", p.of, {{"movement", Progress::kMovement}, {"target", Progress::kTarget}},
               "measure progress by distance moved, or by distance to the active target");
  visit.number("radius_m", p.radius_m, "m", {0.01, 100.0}, "least progress within the time limit");
  visit.number("allowance_s", p.allowance_s, "s", {0.1, 100000.0}, "time limit");
}

/// Says trap when the robot has made no progress for a while: Nav2's SimpleProgressChecker
/// (navigation2, nav2_controller, required_movement_radius 0.5 m, movement_time_allowance 10 s).
/// The robot has made progress when it is radius_m away from where it was when it last had.
///
/// So measured, a robot that goes round and round makes progress. `of: target` measures the
/// distance to the active target instead: progress is to be radius_m nearer than when there last
/// was progress. That wants an allowance of the time that a way round may take.
class NoProgress final : public TrapDetector {
 public:
  using Parameters = NoProgressParameters;

  struct State {
    bool begun = false;
    std::uint64_t tick = 0;  ///< of the last progress
    core::Vec2 position_odom = core::Vec2::Zero();
    double travel_m = 0.0;
    core::Vec2 pursued_odom = core::Vec2::Zero();  ///< the target then
  };

  static core::Result<std::unique_ptr<NoProgress>> create(const Parameters& parameters,
                                                          const domain::BehaviourSetup& setup);
  /// A tick lasts `tick_s`.
  NoProgress(const Parameters& parameters, double tick_s)
      : parameters_(parameters), tick_s_(tick_s) {}

  std::optional<TrapEvidence> observe(const Situation& situation) override;
  void start_afresh() override { state_.begun = false; }
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  bool progressed(const Situation& situation) const;

  Parameters parameters_;
  double tick_s_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, NoProgress::State& s) {
  visit(s.begun, s.tick, s.position_odom, s.travel_m, s.pursued_odom);
}

}  // namespace clew::recover
