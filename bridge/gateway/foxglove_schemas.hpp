// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace clew::bridge {

/// A channel that standard panels of a Foxglove viewer show: its messages are JSON.
struct FoxgloveChannel {
  std::string topic;
  std::string schema_name;
  std::string schema;  ///< JSON Schema
};

/// The numbers of the channels below.
enum class FoxgloveTopic : std::size_t { kScene, kScan, kTransforms, kPath, kLog, kSeen };

/// In the order of FoxgloveTopic.
const std::vector<FoxgloveChannel>& foxglove_channels();

}  // namespace clew::bridge
