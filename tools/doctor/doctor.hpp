// SPDX-License-Identifier: Apache-2.0
/// What a run needs of the machine that it is on, each thing looked at by itself.
#pragma once

#include <string>
#include <vector>

namespace clew::doctor {

/// What one check found.
struct Finding {
  std::string check;  ///< `loopback`
  bool ok = false;
  std::string found;  ///< in words
  std::string fix;    ///< what to do; empty if it is ok
};

/// Where the kernel tells of itself; a test has another place.
struct Machine {
  std::string proc = "/proc";
  std::string shared_memory = "/dev/shm";
};

/// Network, limits, memory, clock and files. Changes nothing.
std::vector<Finding> check_machine(const Machine& machine = {});

/// Who holds DDS domains here, and a sample from each vendor to each, in a free domain on
/// 127.0.0.1. Takes some seconds at the most, and leaves nothing behind.
std::vector<Finding> check_dds(const Machine& machine = {});

}  // namespace clew::doctor
