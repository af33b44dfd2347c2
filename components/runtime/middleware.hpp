// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/nearest_name.hpp"

namespace clew::runtime {

/// DDS vendors, as graph files and the command line name them.
inline const std::vector<std::string> kMiddlewares = {"cyclonedds", "fastdds"};

inline bool is_middleware(const std::string& name) {
  return std::find(kMiddlewares.begin(), kMiddlewares.end(), name) != kMiddlewares.end();
}

/// What is wrong with a name that is none of them.
inline std::string unknown_middleware(const std::string& name) {
  return core::unknown_name("middleware", name, kMiddlewares);
}

}  // namespace clew::runtime
