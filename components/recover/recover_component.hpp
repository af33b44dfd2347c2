// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "recover/detectors/trap_detector.hpp"
#include "recover/escapes/escape.hpp"
#include "recover/escapes/immediate_memory.hpp"
#include "runtime/component.hpp"
#include "runtime/stage.hpp"

namespace clew::recover {

struct RecoverParameters {
  bool immediate_memory = true;
  std::string actions = "krishna_kalra_actions";
  map::LocalMapParameters local_map;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, RecoverParameters& p) {
  visit.flag("immediate_memory", p.immediate_memory,
             "whether landmarks that the trained map knows trigger their actions");
  visit.file("actions", p.actions, "rulebases", "action table of the immediate memory");
  visit.number("seen_cell_m", p.local_map.cell_m, "m", {0.01, 0.1},
               "side of a cell of the local map; paths are planned in cells of twice the side");
  visit.integer("seen_capacity_tiles", p.local_map.capacity_tiles, "1", {1, 1000000},
                "greatest number of tiles of 64 by 64 cells that are kept; a tile takes 1.5 KiB");
  visit.number("seen_hit_spread_m", p.local_map.hit_spread_m, "m", {0.0, 0.3},
               "an obstacle is certain if the arc on which it must lie is at most this long");
}

/// A behaviour and the name that it goes by in events.
template <typename Behaviour>
struct Named {
  std::string name;
  std::unique_ptr<Behaviour> behaviour;
};

/// Watches for traps and leads out of them. One detector is in command; others may watch in shadow,
/// and are only logged. A trap starts the first escape; one that fails hands over to the next, for
/// later traps, too; after the last, the robot seeks again, the detectors start afresh, and the
/// next trap starts the first escape. What the detector in command says while an escape is at work
/// goes to that escape, which may take it up.
///
/// A local map that only later escapes read is begun with the first of these: a run that never
/// needs it does not pay for it.
class RecoverComponent final : public runtime::Component {
 public:
  struct Parts {
    Named<TrapDetector> detector;
    std::vector<Named<TrapDetector>> shadows;
    std::vector<Named<Escape>> escapes;  ///< in order of fallback
    std::optional<ImmediateMemory> immediate_memory;
    std::optional<map::LocalMap> local_map;  ///< if a behaviour reads_local_map()
    bool maps_late = false;  ///< it is begun with the first escape that reads it, not with the run
  };
  struct State {
    bool escaping = false;
    std::uint32_t escape = 0;  ///< index of the one at work, or that the next trap begins with
    bool gave_up = false;
    bool maps = false;      ///< an escape that reads the local map has begun
    TrapEvidence evidence;  ///< of the trap that it is at work on
    std::string why;        ///< the last escape failed, or the robot gave up
    std::optional<core::Vec2> virtual_target_odom;  ///< of the last tick
    std::uint32_t waypoint = 0;                     ///< of the last tick
    /// The mission's target if its heading was met since the robot came within its radius.
    std::optional<core::Vec2> met_odom;
  };

  static std::vector<runtime::PortInfo> ports();

  explicit RecoverComponent(Parts parts) : parts_(std::move(parts)) {}

  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;
  void tell(const runtime::TickInputs& samples, domain::Inside& inside) const override;

 private:
  void decide(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs);
  void tell_detectors(const Situation& situation, domain::Inside& inside) const;
  void tell_escape(const Situation& situation, const domain::Guidance& guidance,
                   domain::Inside& inside) const;
  void see(const Situation& situation, const runtime::TickOutputs& outputs);
  bool is_to_turn(const domain::Target& target, const core::Pose2& pose);
  void wait();
  void notice_arrival(const domain::Target& target);
  void take_evidence(const Situation& situation, domain::Event& event);
  void watch_shadows(const Situation& situation, domain::Event& event);
  void begin_escape(std::uint32_t index, const Situation& situation, domain::Event& event);
  void step_escape(const Situation& situation, domain::Guidance& guidance, domain::Event& event);
  void mark_virtual_target(const domain::Guidance& guidance, domain::Event& event);
  void act_at_once(const Situation& situation, domain::Guidance& guidance, domain::Event& event);
  void stop_escaping();
  void start_detectors_afresh();

  Parts parts_;
  State state_;
  map::PathFinders path_finders_;                 // scratch: shared by the behaviours
  core::Vec2 pursued_odom_ = core::Vec2::Zero();  // scratch: of the last step
};

template <typename Visitor>
void visit_fields(Visitor& visit, RecoverComponent::State& s) {
  visit(s.escaping, s.escape, s.gave_up, s.maps, s.evidence, s.why, s.virtual_target_odom,
        s.waypoint, s.met_odom);
}

}  // namespace clew::recover
