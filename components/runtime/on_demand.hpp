// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "runtime/component.hpp"

namespace clew::runtime {

/// An input that is read, and then required, only if a chosen behaviour needs its topic: a fallback
/// for itself, which no graph wires by itself. So a graph without such a behaviour is wired as if
/// the port were not there, and a third-party component in the stage's place need not read it.
inline PortInfo on_demand_input(Topic topic, std::string doc) {
  return fallback_input(topic, topic, std::move(doc));
}

inline bool is_on_demand(const PortInfo& port) {
  return port.direction == PortInfo::Direction::kInput && port.need == PortInfo::Need::kFallback &&
         port.instead_of == port.topic;
}

}  // namespace clew::runtime
