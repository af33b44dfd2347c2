// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace clew::bench {

/// By what the runs of a bench are put together: family, or how hard the world is for the robot and
/// its sensor.
enum class Grouping { kFamily, kSeverity, kNesting, kBacktrack };

struct GroupingName {
  Grouping grouping;
  const char* name;
};
inline constexpr std::array<GroupingName, 4> kGroupings = {{{Grouping::kFamily, "family"},
                                                            {Grouping::kSeverity, "severity"},
                                                            {Grouping::kNesting, "nesting"},
                                                            {Grouping::kBacktrack, "backtrack"}}};

/// None for a name that is none of kGroupings.
inline std::optional<Grouping> grouping_of(const std::string& name) {
  for (const GroupingName& known : kGroupings) {
    if (name == known.name) return known.grouping;
  }
  return std::nullopt;
}

inline std::vector<std::string> grouping_names() {
  std::vector<std::string> names;
  for (const GroupingName& known : kGroupings) names.emplace_back(known.name);
  return names;
}

}  // namespace clew::bench
