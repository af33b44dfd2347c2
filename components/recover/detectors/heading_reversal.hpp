// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/detectors/heading_window.hpp"
#include "recover/detectors/trap_detector.hpp"

namespace clew::recover {

struct HeadingReversalParameters {
  double reversal_rad = core::radians(160.0);
  std::int64_t window_ticks = 20;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, HeadingReversalParameters& p) {
  visit.angle("reversal_deg", p.reversal_rad, {1.0, 1080.0},
              "a change of heading of more than this is a trap");
  visit.integer("window_ticks", p.window_ticks, "ticks", {1, 10000},
                "longest time over which the change is measured");
}

/// The trap rule of Huang & Lee 1992, as Krishna & Kalra 2000, section 4.5 tell it: the robot is
/// trapped if its orientation changes by more than 160 degrees between successive instants.
///
/// *Deviation, needed:* successive instants are those of a window of 20 ticks, since a tick turns
/// the robot by 16 degrees at most. The change is that of the heading summed up, so that a turn by
/// more than 180 degrees counts as what it is.
class HeadingReversal final : public TrapDetector {
 public:
  using Parameters = HeadingReversalParameters;

  static core::Result<std::unique_ptr<HeadingReversal>> create(const Parameters& parameters,
                                                               const domain::BehaviourSetup&) {
    return std::make_unique<HeadingReversal>(parameters);
  }
  explicit HeadingReversal(const Parameters& parameters)
      : parameters_(parameters), window_(static_cast<std::size_t>(parameters.window_ticks)) {}

  std::optional<TrapEvidence> observe(const Situation& situation) override;
  void start_afresh() override { window_.clear(); }
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  Parameters parameters_;
  HeadingWindow window_;
};

}  // namespace clew::recover
