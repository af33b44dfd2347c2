// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

namespace clew::bridge {

/// The topics that a participant may write and read.
struct Rights {
  std::set<std::string> writes;
  std::set<std::string> reads;
};

}  // namespace clew::bridge
