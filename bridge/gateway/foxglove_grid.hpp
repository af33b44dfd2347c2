// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "domain/messages.hpp"
#include "map/local_map.hpp"

namespace clew::bridge {

/// What the robot has seen, as a `foxglove.Grid` in the frame of odometry: 0 free, 100 an obstacle,
/// 50 a suspected one, -1 unknown. A viewer that is passed some ticks only is shown what was seen
/// in those.
class FoxgloveGrid {
 public:
  explicit FoxgloveGrid(double radius_m);

  /// Takes in what a tick shows.
  void see(const domain::Odometry& odometry, const domain::Scan& scan);
  /// The message, if one is due: with the first scan, once a simulated second, and at the end. None
  /// of a map that is too large to be sent again and again.
  std::optional<std::string> message(std::uint64_t time_ns, bool at_end);

 private:
  map::LocalMap map_;
  std::optional<std::uint64_t> sent_ns_;
  bool has_seen_ = false;
};

}  // namespace clew::bridge
