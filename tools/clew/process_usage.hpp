// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace clew::tools {

/// What a process of this host takes, as /proc tells it.
struct ProcessUsage {
  double cpu_s = 0.0;  ///< in all of its threads, since it began
  std::uint64_t resident_bytes = 0;
};

/// None of a process that is not there.
std::optional<ProcessUsage> usage_of(std::int64_t process_id);

}  // namespace clew::tools
