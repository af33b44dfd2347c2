// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bag_import/bag_reader.hpp"
#include "core/result.hpp"
#include "runtime/config_source.hpp"
#include "runtime/graph.hpp"
#include "runtime/stage.hpp"

namespace clew::bag_import {

struct BagImport {
  std::string bag;
  std::string output;
  bool force = false;
  std::string graph = "default";
  runtime::GraphOverrides overrides;  ///< but the world
  BagTopics topics;
  std::optional<core::Vec2> target;  ///< in the odometry frame; none: where the bag ends
};

/// What came of a bag.
struct ImportedBag {
  std::uint64_t ticks = 0;
  double sim_time_s = 0.0;
  bool laser_is_known = false;  ///< where it stands on the robot
};

/// Makes a recording of a run of a bag: its scans as the graph's sensor would have measured them
/// and its odometry take the places of *sense* and *drive*, tick by tick, and the graph's other
/// stages step on them. What they command moves nothing. So each of them can be replayed, swapped
/// and drawn like those of a run. The world is an empty one around the path; the stamps of the
/// messages decide what belongs to a tick: the last one before its end.
core::Result<ImportedBag> import_bag(const BagImport& order,
                                     const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::bag_import
