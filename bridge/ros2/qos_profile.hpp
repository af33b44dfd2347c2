// SPDX-License-Identifier: Apache-2.0
/// The QoS of topics as ROS 2 nodes have it: rmw's profiles, and those of tf2_ros, Nav2 and
/// rosgraph. A writer is RELIABLE wherever that costs nothing, since it serves readers of both
/// kinds.
#pragma once

#include <string>

#include "dds/participant.hpp"

namespace clew::ros2 {

struct QosProfile {
  bool reliable = true;
  bool transient_local = false;
  int depth = 10;

  bridge::Qos qos() const { return {reliable, transient_local, true}; }
};

inline constexpr QosProfile kDefaultProfile{true, false, 10};
inline constexpr QosProfile kScanProfile{true, false, 5};
inline constexpr QosProfile kTfProfile{true, false, 100};
inline constexpr QosProfile kLatchedProfile{true, true, 1};  ///< maps, static transforms, goals
inline constexpr QosProfile kClockProfile{false, false, 1};
inline constexpr QosProfile kLogProfile{true, true, 1000};
/// What a reader takes that wants whatever there is.
inline constexpr QosProfile kSensorReaderProfile{false, false, 5};

/// The profile as rosbag2 writes it into `offered_qos_profiles`, from version 9 of its metadata on.
std::string offered_qos_yaml(const QosProfile& profile);

}  // namespace clew::ros2
