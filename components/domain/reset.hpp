// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "domain/messages.hpp"

namespace clew::domain {

/// Sets a message to *nothing*: default values, keeping the memory it has.
template <typename Message>
void reset(Message& message) {
  message = Message{};
}
inline void reset(Scan& scan) {
  std::vector<double> ranges = std::move(scan.ranges_m);
  ranges.clear();
  scan = Scan{};
  scan.ranges_m = std::move(ranges);
}
inline void reset(Event& event) {
  event.stamp = {};
  event.entries.clear();
}

}  // namespace clew::domain
