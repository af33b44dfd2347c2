// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "run/sample_sink.hpp"
#include "wire/codec.hpp"
#include "world_analysis/trap_map.hpp"

namespace clew::bench {

/// How a detector did in a run, in command or in shadow.
struct DetectorScore {
  std::string rule;
  bool shadow = false;
  std::uint32_t alarms = 0;        ///< all of them
  std::uint32_t false_alarms = 0;  ///< neither held by a trap nor in a circle
  std::uint32_t noticed = 0;       ///< captures with at least one alarm
  std::vector<double> delays_s;    ///< from the start of each capture noticed to its first alarm
  std::vector<double> delays_m;    ///< the same in travel
};

/// Judges the alarms of a run against what is true.
///
/// A trap *holds* the robot from when it enters the trap's region until it is nearer to the target
/// than the trap's minimum, which only leaving the trap for good allows; entering another trap
/// meanwhile, an inner one or the next, prolongs the same *capture*. The robot goes *in a circle*
/// when its body overlaps where it stood more than 1 m of travel before: limit cycles of a
/// controller need no trap. An alarm is true during a capture and in a circle, else false. So one
/// outside of the region on the second round of a limit cycle is true, and one on a new way between
/// round obstacles is false.
///
/// As a sample sink it takes the run's state and events, and looks at nothing else.
class TrapJudge : public bridge::SampleSink {
 public:
  /// `traps` may be null: then there is no truth, and alarms are counted and not judged.
  /// `detectors` are those of the graph, so that one without any alarm has a score as well.
  TrapJudge(const world_analysis::TrapMap* traps, double robot_radius_m,
            std::vector<DetectorScore> detectors)
      : traps_(traps), robot_radius_m_(robot_radius_m), scores_(std::move(detectors)) {}

  core::Result<void> add(const bridge::SampleView& sample) override;

  /// One tick: where the robot is, then what was said. For tests without a run.
  void add(const domain::State& state);
  void add(const domain::Event& event);

  bool has_truth() const { return traps_ != nullptr; }
  std::uint32_t captures() const { return captures_; }
  bool is_held() const { return held_below_m_.has_value(); }
  const std::vector<DetectorScore>& scores() const { return scores_; }

 private:
  void begin_capture(const domain::State& state);
  void alarm(const domain::EventEntry& entry);
  bool is_in_circle() const;

  struct Footprint {
    core::Vec2 position = core::Vec2::Zero();
    double travel_m = 0.0;
  };

  const world_analysis::TrapMap* traps_;
  double robot_radius_m_;
  std::vector<DetectorScore> scores_;
  std::vector<bool> has_noticed_ = std::vector<bool>(scores_.size());  ///< the present capture
  std::optional<double> held_below_m_;  ///< free when nearer to the target than this; none: free
  std::uint32_t captures_ = 0;
  std::vector<Footprint> track_;  ///< a tick each
  double time_s_ = 0.0;
  double captured_at_s_ = 0.0;
  double captured_at_m_ = 0.0;
  bridge::Codec<domain::State> states_;
  bridge::Codec<domain::Event> events_;
  domain::State state_;
  domain::Event event_;
};

}  // namespace clew::bench
