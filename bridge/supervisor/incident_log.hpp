// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "domain/incident.hpp"

namespace clew::bridge {

/// Tells which incidents are worth a line: the same is told once, and of each kind no more than
/// kMostTold. So a stranger who does a thing again and again, or a new one each time, fills neither
/// log nor recording, and hides nothing of another kind.
class IncidentLog {
 public:
  static constexpr std::size_t kMostTold = 100;

  /// What is to be told, as one line of bounded length; none if it was told before, or enough was.
  std::optional<domain::Incident> note(domain::Incident incident);
  /// An incident for each kind of which some were not told since the last call: how many.
  std::vector<domain::Incident> take_left_out();

 private:
  struct Kind {
    std::set<std::pair<std::string, std::string>> told;  ///< stage and text
    std::uint64_t left_out = 0;
  };

  std::map<std::string, Kind> kinds_;
};

}  // namespace clew::bridge
