// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "domain/messages.hpp"
#include "ros2/conversions.hpp"
#include "ros2/messages.hpp"

namespace clew::ros2 {

/// What happened in a run, as markers in the odometry frame: traps (red), virtual targets (blue),
/// landmarks (green); of each kind the last hundred.
class RunMarkers {
 public:
  static constexpr std::size_t kMostOfAKind = 100;

  explicit RunMarkers(const Frames& frames) : frame_(frames.odom) {}

  /// Adds what is worth a marker.
  void add(const domain::TickStamp& stamp, const domain::EventEntry& entry);
  /// Whether something came since the last call of all().
  bool changed() const { return changed_; }
  /// All markers, so that a late reader sees them, too; the first one deletes those before.
  MarkerArray all();

 private:
  std::string frame_;
  std::map<std::string, std::deque<Marker>> markers_;  ///< by namespace, as RViz shows them
  std::int32_t next_id_ = 0;
  bool changed_ = false;
};

/// A line of /rosout for what happened.
Log to_log(const domain::TickStamp& stamp, const domain::EventEntry& entry,
           const std::string& node);

}  // namespace clew::ros2
