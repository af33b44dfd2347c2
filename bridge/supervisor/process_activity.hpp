// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace clew::bridge {

/// What the kernel says of a process and all that it started.
struct ProcessActivity {
  bool stopped = false;      ///< the process itself, by a signal or a debugger
  bool runnable = false;     ///< a thread runs, or would if it were given a processor or a disk
  double processor_s = 0.0;  ///< that they have used so far
};

/// None if there is no such process.
std::optional<ProcessActivity> activity_of(std::int64_t process_id);

}  // namespace clew::bridge
