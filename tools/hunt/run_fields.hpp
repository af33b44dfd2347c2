// SPDX-License-Identifier: Apache-2.0
/// What a property may speak of: the fields of a run, by name and type.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::hunt {

enum class FieldType { kNumber, kFlag, kWord };

/// The fields, in the order of the table.
enum class Field : std::size_t {
  kOutcome,
  kTicks,
  kSimTime_s,
  kPathLength_m,
  kShortestPath_m,
  kPathRatio,
  kDistance_m,
  kClearance_m,
  kTrapsDetected,
  kVirtualTargets,
  kCollisions,
  kHitBy,
  kSafetyStops,
  kCaptures,
  kHeldAtEnd,
  kFalseAlarms,
  kTimeToAlarm_s,
  kSolvable,
  kSuccess,
  kTimeLeft,
  kCount
};

inline constexpr std::size_t kFields = static_cast<std::size_t>(Field::kCount);

struct FieldInfo {
  std::string name;
  FieldType type = FieldType::kNumber;
  /// A difference that matters: what robustness is measured in. 1 for flags and words.
  double scale = 1.0;
  std::string doc;                 ///< one line
  std::vector<std::string> words;  ///< of a word field, in the order of their numbers
};

/// The table; index it with a Field.
const std::array<FieldInfo, kFields>& fields();

/// What a run came to. A flag is 0 or 1, a word its number in FieldInfo::words. None: there is no
/// such value, as the shortest path in a world that moves for ever.
class FieldValues {
 public:
  const std::optional<double>& operator[](Field field) const {
    return values_[static_cast<std::size_t>(field)];
  }
  void set(Field field, std::optional<double> value) {
    values_[static_cast<std::size_t>(field)] = value;
  }
  /// Of a field of words; an unknown word is none.
  void set_word(Field field, const std::string& word);
  /// The word's text; empty for none.
  std::string word(Field field) const;

 private:
  std::array<std::optional<double>, kFields> values_;
};

}  // namespace clew::hunt
