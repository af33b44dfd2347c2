// SPDX-License-Identifier: Apache-2.0
#include "hunt/run_fields.hpp"

#include <algorithm>

namespace clew::hunt {

const std::array<FieldInfo, kFields>& fields() {
  constexpr auto kNumber = FieldType::kNumber;
  constexpr auto kFlag = FieldType::kFlag;
  static const std::array<FieldInfo, kFields> all = {{
      {"outcome",
       FieldType::kWord,
       1.0,
       "how the run ended",
       {"reached", "collided", "unreachable", "timeout", "aborted"}},
      {"ticks", kNumber, 100.0, "ticks of the run", {}},
      {"sim_time_s", kNumber, 30.0, "simulated time", {}},
      {"path_length_m", kNumber, 5.0, "way that the robot went", {}},
      {"shortest_path_m", kNumber, 5.0, "shortest way from the start", {}},
      {"path_ratio", kNumber, 1.0, "path_length_m / shortest_path_m, however the run ended", {}},
      {"distance_m", kNumber, 1.0, "from the robot's last place to the target's", {}},
      {"clearance_m", kNumber, 0.1, "least room beside the robot's body, at most 2", {}},
      {"traps_detected", kNumber, 1.0, "traps that the detectors in command announced", {}},
      {"virtual_targets", kNumber, 5.0, "virtual targets set", {}},
      {"collisions", kNumber, 1.0, "contacts that the robot moved into", {}},
      {"hit_by", kNumber, 1.0, "contacts that a moving obstacle moved into", {}},
      {"safety_stops", kNumber, 5.0, "times that the safety layer stopped the robot", {}},
      {"captures", kNumber, 1.0, "times that a trap held the robot", {}},
      {"held_at_end", kFlag, 1.0, "a trap held the robot at the end", {}},
      {"false_alarms", kNumber, 1.0, "alarms in command outside of traps and circles", {}},
      {"time_to_alarm_s",
       kNumber,
       30.0,
       "longest time from a capture to its first alarm in command; endless if none came",
       {}},
      {"solvable", kFlag, 1.0, "there is a way from the start to the target", {}},
      {"success", kFlag, 1.0, "reached if solvable, else unreachable", {}},
      {"time_left", kNumber, 1.0, "share of max_ticks that was left, 0 to 1", {}},
  }};
  return all;
}

void FieldValues::set_word(Field field, const std::string& word) {
  const auto& words = fields()[static_cast<std::size_t>(field)].words;
  const auto found = std::find(words.begin(), words.end(), word);
  set(field, found == words.end()
                 ? std::nullopt
                 : std::optional<double>(static_cast<double>(std::distance(words.begin(), found))));
}

std::string FieldValues::word(Field field) const {
  const auto& value = (*this)[field];
  if (!value) return {};
  return fields()[static_cast<std::size_t>(field)].words[static_cast<std::size_t>(*value)];
}

}  // namespace clew::hunt
